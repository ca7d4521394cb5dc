//! The report that `vcutc watch --serve` shows, in a browser that stays open while the job is edited.

use super::browser::Browser;
use crate::cli::watch::Watch;
use std::fs;

#[test]
fn a_report_is_where_it_was_after_errors_in_between() {
    let Some(browser) = Browser::start() else { return };
    let watch = Watch::start(&["--serve", "0"]);
    let tab = browser.open_at(&format!("http://{}/", watch.address()), 1280, 700);
    let size = watch.path().join("size.vcut");
    tab.value("window.scrollTo(0, 777)");
    for (text, title) in [
        ("let width = 44 mm\n", "rib - vcutc report"),
        ("let width = 44 mn\n", "rib.vcut - errors"),
        ("let width = 44 mm mm\n", "rib.vcut - errors"),
        ("let width = 46 mm\n", "rib - vcutc report"),
    ] {
        let version = tab.value("document.querySelector('meta[name=vcutc-version]').content");
        fs::write(&size, text).unwrap();
        tab.wait_until(&format!(
            "document.readyState === 'complete' \
             && document.querySelector('meta[name=vcutc-version]').content !== {version} \
             && document.title === '{title}'"
        ));
        if title.ends_with("report") {
            tab.wait_until("window.scrollY === 777");
        } else {
            // Line by line and coloured, and below it what there was before.
            assert!(tab.holds("document.querySelector('.messages').textContent.split('\\n').length > 5"));
            assert!(tab.holds("document.querySelector('.messages .c1').textContent.startsWith('error[VC')"));
            assert!(tab.holds("document.querySelector('.messages').textContent.includes('size.vcut:1:')"));
            assert!(tab.holds("document.querySelector('.stale h1').textContent === 'rib'"));
            assert!(tab.holds("document.querySelector('.stale #cross-section svg') !== null"));
            assert!(tab.holds("vcutPlayback.duration() > 0"));
            // A live page asks for changes, and for itself again.
            let mut complaints = tab.complaints();
            complaints.retain(|one| !one.contains("\"requestId\""));
            assert!(complaints.is_empty(), "{complaints:#?}");
        }
    }
}
