"use strict";
// Loads the page anew when the server has another version of it. A server that has gone is asked again by the browser.
{
  const version = document.querySelector('meta[name="vcutc-version"]').content;
  const changes = new EventSource(`changes?${encodeURIComponent(version)}`);
  changes.addEventListener("message", () => {
    changes.close();
    location.reload();
  });
}
