"use strict";
// Loads the page anew when the server has another version of it. A server that has gone is asked again by the browser.
// Where a report was scrolled to is kept by the tab, so that messages of errors in between do not lose it: they are short,
// and the browser would go back to where they end.
{
  const KEY = "vcutc-scrolled-to";
  const isReport = !document.querySelector("main[data-shows=errors]");
  const version = document.querySelector('meta[name="vcutc-version"]').content;
  const changes = new EventSource(`changes?${encodeURIComponent(version)}`);
  changes.addEventListener("message", () => {
    changes.close();
    location.reload();
  });
  // A browser may be set to keep nothing.
  try {
    history.scrollRestoration = "manual";
    const kept = sessionStorage.getItem(KEY);
    if (isReport && kept !== null) {
      window.scrollTo(0, Number(kept));
    }
    if (isReport) {
      window.addEventListener("pagehide", () => sessionStorage.setItem(KEY, String(window.scrollY)));
    }
  } catch {
    history.scrollRestoration = "auto";
  }
}
