//! What has to be set up before the program runs: the program itself, stock and zero, blade, frames, home and
//! generator. The set-up sheet (`vcutc report --sheet`) has the same facts for paper.

use super::figure::{Zoom, framed};
use super::{Section, Subject};
use crate::digest::hexadecimal;
use crate::facts::{self, Fact};
use crate::html::{Html, terms};
use vcutc_picture::{Prefix, setup};

pub(super) fn section(subject: Subject<'_>) -> Section {
    let material = &subject.material;
    let job = material.job;
    let machine = job.machine.as_ref();
    let size = [job.stock.width, job.stock.depth, job.stock.height].map(|length| length.to_mm());
    let sketch = setup::stock(Prefix::new("stock-"), size);
    let facts: Vec<Fact> = [
        program(subject),
        facts::stock(job),
        facts::base(machine),
        facts::of_blades(&facts::blades(material)),
        facts::tool(material),
        facts::control(material),
        facts::speeds(material),
    ]
    .concat();
    let list = terms(facts.iter().map(|(name, value)| (*name, value.as_str())));
    let caption = "The stock with the zero of the work; the base frame of the control is measured there.";
    Section {
        id: "set-up",
        title: "Set-up",
        body: html!(
            "set_up.html",
            sketch = framed(sketch, "sketch", Zoom::Fixed, caption),
            facts = list,
            files = files(subject),
        ),
    }
}

/// What the program is known by.
fn program(subject: Subject<'_>) -> Vec<Fact> {
    let program = subject.material.compiled.program.verified().program();
    let mut facts = vec![("program", program.name.clone())];
    facts.extend(
        program
            .head
            .as_ref()
            .map(|head| ("hash of the job", head.job.clone())),
    );
    facts
}

/// The files of the program, where it was written for a target.
fn files(subject: Subject<'_>) -> Option<Html> {
    let files = subject.further.files;
    let row = |(name, bytes): &(&str, &[u8])| {
        html!(
            in "<div><dt>{name}</dt><dd><code>{digest}</code></dd></div>\n",
            name = name,
            digest = hexadecimal(bytes)
        )
    };
    let rows: Html = files.iter().map(row).collect();
    (!files.is_empty()).then(|| html!("files.html", rows = rows))
}
