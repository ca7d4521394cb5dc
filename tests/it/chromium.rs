//! Pages in a browser: Chromium without a window, driven over its DevTools protocol.
//!
//! `.ci/run` installs it. Where it is missing the tests are skipped and say so, unless `VCUTC_REFEREES` is `required`.

mod browser;
mod live;
mod page;
mod space;
