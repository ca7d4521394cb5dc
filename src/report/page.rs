//! The page of a report: one HTML text that holds all there is to see of a job and asks for nothing from outside.
//!
//! Its parts are functions from the result of the job to a piece of HTML, put in their order here. Style and
//! script stand in `src/report/assets` and are copied into the page. Its policy ([`policy`]) names every
//! script by its hash and forbids all requests, so that a name in a job that got past the escaping would
//! still be no more than text. There is no date and no path but the job's own in it: the same job gives the
//! same bytes.

mod ansi;
mod cross_section;
mod cuts;
mod deviation;
mod figure;
mod help;
mod live;
mod machine;
mod parameters;
mod pockets;
pub(super) mod policy;
mod set_up;
mod source;
mod surface;
mod times;
mod top;

use super::html::Html;
use super::{Material, playback, space};
pub use live::Served;
use policy::Requests;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::SourceMap;
use vcutc_driver::Outcome;
use vcutc_driver::checks::ReadBack;
use vcutc_driver::hints::Hint;
use vcutc_driver::summary;
use vcutc_picture::dark;

/// What a page is made from.
#[derive(Clone, Copy)]
struct Subject<'a> {
    /// Job, plan and program.
    material: Material<'a>,
    /// All texts that the job was made from.
    sources: &'a SourceMap,
    /// What there was to warn of.
    warnings: &'a [Diagnostic],
    /// What else there is to show.
    further: Further<'a>,
}

/// What a page shows in addition to the outcome, as far as it was asked for.
#[derive(Clone, Copy, Debug)]
pub struct Further<'a> {
    /// The files of the program, with their bytes.
    pub files: &'a [(&'a str, &'a [u8])],
    /// The result of reading them again, where there are some.
    pub read_back: Option<ReadBack>,
    /// Changes that were found to make the job faster.
    pub hints: &'a [Hint],
}

impl Further<'_> {
    pub const NOTHING: Self = Self {
        files: &[],
        read_back: None,
        hints: &[],
    };
}

/// A section of the page.
struct Section {
    /// Its place within the page, for links.
    id: &'static str,
    /// Its heading.
    title: &'static str,
    /// What it holds.
    body: Html,
}

const STYLE: &str = include_str!("assets/page.css");
const SCRIPT: &str = include_str!("assets/page.js");

/// The page of an outcome; none while its job has errors.
#[must_use]
pub fn page(outcome: &Outcome, further: Further<'_>) -> Option<String> {
    Some(document(&Content::of(outcome, further)?, None))
}

/// What a page shows, without what is around it: it can be shown once more below messages of errors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Content {
    /// The job's name.
    name: String,
    /// Job, verdict, warnings and table of contents.
    top: Html,
    /// Key numbers and sections.
    body: Html,
}

impl Content {
    /// Of an outcome; none while its job has errors.
    #[must_use]
    pub fn of(outcome: &Outcome, further: Further<'_>) -> Option<Self> {
        let subject = Subject {
            material: Material::of(outcome)?,
            sources: &outcome.sources,
            warnings: &outcome.diagnostics,
            further,
        };
        let listing = source::Listing::of(subject);
        let has_section = !summary::is_of_regions(subject.material.plan);
        let sections = [
            Some(played(subject)),
            has_section.then(|| cross_section::section(subject)),
            surface::section(subject),
            pockets::section(subject),
            has_section.then(|| deviation::section(subject)),
            machine::section(subject),
            Some(times::section(subject)),
            Some(set_up::section(subject)),
            Some(parameters::section(subject, &listing)),
            Some(listing.section()),
        ];
        let sections: Vec<Section> = sections.into_iter().flatten().collect();
        let link = |section: &Section| {
            html!(
                in "<li><a href=\"#{id}\">{title}</a></li>\n",
                id = section.id,
                title = section.title
            )
        };
        let links: Html = sections.iter().map(link).collect();
        let section = |section: &Section| {
            html!(
                "section.html",
                id = section.id,
                title = section.title,
                body = section.body
            )
        };
        let shown: Html = sections.iter().map(section).collect();
        Some(Self {
            name: subject.material.job.name.clone(),
            top: top::header(subject) + html!("contents.html", links = links),
            body: top::key_numbers(subject) + help::block(subject, &listing) + shown,
        })
    }
}

/// The page of an outcome for a browser that watches it.
#[must_use]
pub fn served_page(content: &Content, served: &Served) -> String {
    document(content, Some(served))
}

/// What is shown while a job has errors: the messages as they are printed on a terminal, with its colours (`messages` holds
/// its sequences), and below them the last report without errors, marked as out of date.
#[must_use]
pub fn served_errors(job: &str, messages: &str, last: Option<&Content>, served: &Served) -> String {
    let mut body = html!(
        "errors.html",
        job = job,
        last = last.map(|_| " The last report without them is below."),
        messages = ansi::html(messages),
    );
    if let Some(content) = last {
        body += html!(
            "stale.html",
            top = content.top,
            content = content.body,
            script = Html::trusted(SCRIPT)
        );
    }
    let scripts: &[&str] = match last {
        None => &[],
        Some(_) => &[SCRIPT, playback::SCRIPT, space::SCRIPT],
    };
    around(&body, &format!("{job} - errors"), scripts, Some(served))
}

/// The cuts played back in space.
fn played(subject: Subject<'_>) -> Section {
    let Material { plan, compiled, .. } = subject.material;
    Section {
        id: "playback",
        title: "Playback",
        body: Html::trusted(playback::section(plan, compiled)),
    }
}

/// The document around what it shows.
fn document(content: &Content, served: Option<&Served>) -> String {
    let body = html!(
        "page.html",
        trouble = served.and_then(Served::banner),
        top = content.top,
        content = content.body,
        version = env!("CARGO_PKG_VERSION"),
        script = Html::trusted(SCRIPT),
    );
    let title = format!("{} - vcutc report", content.name);
    around(&body, &title, &[SCRIPT, playback::SCRIPT, space::SCRIPT], served)
}

/// A document around its body, with a policy for its scripts and, where a server shows it, one more.
fn around(body: &Html, title: &str, scripts: &[&str], served: Option<&Served>) -> String {
    let requests = served.map_or(Requests::None, |_| Requests::OwnServer);
    let live = served.map(|_| live::SCRIPT);
    let scripts: Vec<&str> = scripts.iter().copied().chain(live).collect();
    let document = html!(
        "document.html",
        policy = policy::policy(&scripts, requests),
        version = served.map(Served::meta),
        title = title,
        style = Html::trusted(STYLE),
        dark = Html::trusted(dark(".view svg")),
        body = body,
        live = live.map(|script| html!(in "<script>{script}</script>\n", script = Html::trusted(script))),
    );
    document.into_text()
}
