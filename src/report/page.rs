//! The page of a report: one HTML text that holds all there is to see of a job and asks for nothing from outside.
//!
//! Its parts are functions from what came of the job to a piece of HTML, put in their order here. Style and script stand
//! in `src/report/assets` and are copied into the page. Its policy ([`policy`]) names every script by its hash and forbids
//! all requests, so that a name in a job that got past the escaping would still be no more than text. There is no date and no path
//! but the job's own in it: the same job gives the same bytes.

mod ansi;
mod cross_section;
mod cuts;
mod deviation;
mod figure;
mod help;
pub(super) mod html;
mod live;
mod machine;
mod parameters;
pub(super) mod policy;
mod set_up;
mod source;
mod times;
mod top;

use super::{Material, playback};
use html::escaped;
pub use live::Served;
use policy::Requests;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::SourceMap;
use vcutc_driver::Outcome;
use vcutc_driver::checks::ReadBack;
use vcutc_driver::hints::Hint;
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

/// What a page shows besides the outcome, as far as it was asked for.
#[derive(Clone, Copy, Debug)]
pub struct Further<'a> {
    /// The files of the program, with their bytes.
    pub files: &'a [(&'a str, &'a [u8])],
    /// What came of reading them again, where there are some.
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
    /// What it holds, as HTML.
    body: String,
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
    /// The job's name, as HTML.
    name: String,
    /// Job, verdict, warnings and table of contents.
    top: String,
    /// Key numbers and sections.
    body: String,
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
        let sections = [
            Some(played(subject)),
            Some(cross_section::section(subject)),
            Some(deviation::section(subject)),
            machine::section(subject),
            Some(times::section(subject)),
            Some(set_up::section(subject)),
            Some(parameters::section(subject, &listing)),
            Some(listing.section()),
        ];
        let sections: Vec<Section> = sections.into_iter().flatten().collect();
        let mut body = top::key_numbers(subject) + &help::block(subject, &listing);
        for Section {
            id,
            title,
            body: held,
        } in &sections
        {
            body += &format!(
                "<section id=\"{id}\" aria-labelledby=\"{id}-heading\">\n<h2 id=\"{id}-heading\">{title}</h2>\n{held}</section>\n"
            );
        }
        Some(Self {
            name: escaped(&subject.material.job.name),
            top: top::header(subject) + &contents(&sections),
            body,
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
    let (scripts, stale): (&[&str], String) = match last {
        None => (&[], String::new()),
        Some(content) => (
            &[SCRIPT, playback::SCRIPT],
            format!(
                "<div class=\"stale\" role=\"region\" aria-label=\"The last report without errors\">\n\
                 <p class=\"stale-note\">Out of date: the last report without errors</p>\n{}{}</div>\n<script>{SCRIPT}</script>\n",
                content.top, content.body
            ),
        ),
    };
    let body = format!(
        "<main id=\"content\" data-shows=\"errors\">\n<h1>{}</h1>\n<p class=\"trouble\" role=\"alert\">This job has errors.{}</p>\n\
         <pre class=\"messages\" tabindex=\"0\">{}</pre>\n</main>\n",
        escaped(job),
        if last.is_some() {
            " The last report without them is below."
        } else {
            ""
        },
        ansi::html(messages)
    );
    let head = head(&format!("{} - errors", escaped(job)), scripts, Some(served));
    format!("{head}{body}{stale}{}</body>\n</html>\n", live::element())
}

/// The cuts played back in space.
fn played(subject: Subject<'_>) -> Section {
    let Material { plan, compiled, .. } = subject.material;
    Section {
        id: "playback",
        title: "Playback",
        body: playback::section(plan, compiled),
    }
}

/// The beginning of a document: all before what it shows.
fn head(title: &str, scripts: &[&str], served: Option<&Served>) -> String {
    let (requests, version) = match served {
        Some(served) => (Requests::OwnServer, served.meta()),
        None => (Requests::None, String::new()),
    };
    let live = served.map(|_| live::SCRIPT);
    let scripts: Vec<&str> = scripts.iter().copied().chain(live).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n{version}\
         <title>{title}</title>\n<style>\n{STYLE}@media screen and (prefers-color-scheme: dark) {{\n{}}}\n</style>\n</head>\n<body>\n",
        policy::policy(&scripts, requests),
        dark(".view svg"),
    )
}

/// The document around what it shows.
fn document(content: &Content, served: Option<&Served>) -> String {
    let title = format!("{} - vcutc report", content.name);
    let mut page = head(&title, &[SCRIPT, playback::SCRIPT], served);
    page += "<a class=\"skip\" href=\"#content\">Skip to the content</a>\n";
    page += &served.map(Served::banner).unwrap_or_default();
    page += &content.top;
    page += "<main id=\"content\">\n";
    page += &content.body;
    page += "</main>\n<footer>Made by vcutc ";
    page += env!("CARGO_PKG_VERSION");
    page += ". The file is complete in itself: it loads nothing.</footer>\n<script>";
    page += SCRIPT;
    page += "</script>\n";
    page += &served.map(|_| live::element()).unwrap_or_default();
    page += "</body>\n</html>\n";
    page
}

/// The table of contents.
fn contents(sections: &[Section]) -> String {
    let links: String = sections
        .iter()
        .map(|Section { id, title, .. }| format!("<li><a href=\"#{id}\">{title}</a></li>\n"))
        .collect();
    format!("<nav aria-label=\"Contents\">\n<ul>\n{links}</ul>\n</nav>\n")
}
