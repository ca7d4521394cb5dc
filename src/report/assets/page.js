"use strict";
// Pictures that can be enlarged and moved. All that changes is the viewBox of the SVG: what is drawn stays sharp, and
// `All` brings it back. The wheel enlarges only after a click into the picture or with Ctrl held, so that a page can be
// scrolled past it.
(() => {
  /** Smallest part of a picture that is shown, as a share of its width. */
  const CLOSEST = 1 / 400;

  /** @param {HTMLElement} figure */
  function zoomable(figure) {
    const view = figure.querySelector(".view");
    const svg = view.querySelector("svg");
    const whole = svg.viewBox.baseVal;
    const all = { x: whole.x, y: whole.y, width: whole.width, height: whole.height };
    let now = { ...all };
    /** Fingers and the mouse button, by id: where they are on the screen. */
    const held = new Map();

    function show(next) {
      const width = Math.min(Math.max(next.width, all.width * CLOSEST), all.width);
      const height = (width / all.width) * all.height;
      const within = (value, least, most) => Math.min(Math.max(value, least), most);
      now = {
        x: within(next.x, all.x, all.x + all.width - width),
        y: within(next.y, all.y, all.y + all.height - height),
        width,
        height,
      };
      svg.setAttribute("viewBox", [now.x, now.y, now.width, now.height].map((value) => +value.toFixed(4)).join(" "));
      figure.classList.toggle("enlarged", width < all.width);
    }

    /** A place on the screen in the picture's own units. */
    function place(x, y) {
      const point = new DOMPoint(x, y).matrixTransform(svg.getScreenCTM().inverse());
      return { x: point.x, y: point.y };
    }

    /** Enlarges by a factor about a point, which stays where it is. */
    function enlarge(factor, about) {
      const width = Math.min(Math.max(now.width / factor, all.width * CLOSEST), all.width);
      const share = width / now.width;
      show({ x: about.x - (about.x - now.x) * share, y: about.y - (about.y - now.y) * share, width });
    }

    const middle = () => ({ x: now.x + now.width / 2, y: now.y + now.height / 2 });
    const move = (x, y) => show({ x: now.x + x, y: now.y + y, width: now.width });

    const deeds = {
      in: () => enlarge(1.5, middle()),
      out: () => enlarge(1 / 1.5, middle()),
      all: () => show(all),
    };
    for (const button of figure.querySelectorAll("[data-do]")) {
      button.addEventListener("click", deeds[button.dataset.do]);
    }

    view.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && document.activeElement !== view) return;
      event.preventDefault();
      const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
      enlarge(Math.exp(-event.deltaY * lines * 0.002), place(event.clientX, event.clientY));
    }, { passive: false });

    view.addEventListener("keydown", (event) => {
      const step = now.width / 10;
      const keys = {
        "+": deeds.in, "=": deeds.in, "-": deeds.out, "0": deeds.all,
        ArrowLeft: () => move(-step, 0), ArrowRight: () => move(step, 0),
        ArrowUp: () => move(0, -step), ArrowDown: () => move(0, step),
      };
      const deed = keys[event.key];
      if (!deed || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      deed();
    });

    view.addEventListener("dblclick", deeds.all);

    view.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      held.set(event.pointerId, { x: event.clientX, y: event.clientY });
      view.setPointerCapture(event.pointerId);
    });
    view.addEventListener("pointermove", (event) => {
      const before = held.get(event.pointerId);
      if (!before) return;
      const after = { x: event.clientX, y: event.clientY };
      const other = [...held].find(([id]) => id !== event.pointerId)?.[1];
      held.set(event.pointerId, after);
      const [from, to] = [place(before.x, before.y), place(after.x, after.y)];
      if (other) {
        const apart = (point) => Math.hypot(point.x - other.x, point.y - other.y);
        if (apart(before) > 0) enlarge(apart(after) / apart(before), place(other.x, other.y));
      } else if (now.width < all.width) {
        view.classList.add("dragged");
        move(from.x - to.x, from.y - to.y);
      }
    });
    for (const end of ["pointerup", "pointercancel"]) {
      view.addEventListener(end, (event) => {
        held.delete(event.pointerId);
        view.classList.remove("dragged");
      });
    }
  }

  for (const figure of document.querySelectorAll("figure[data-zoom]")) zoomable(figure);

  /** Marks what goes on to the right of what is seen of it. */
  function hint(box) {
    box.classList.toggle("more", box.scrollLeft + box.clientWidth < box.scrollWidth - 1);
  }
  const sized = new ResizeObserver((changes) => changes.forEach(({ target }) => hint(target)));
  for (const box of document.querySelectorAll(".wide")) {
    box.addEventListener("scroll", () => hint(box), { passive: true });
    sized.observe(box);
  }

  // A link to a line of a text that is folded away unfolds it.
  function unfold() {
    const target = document.getElementById(location.hash.slice(1));
    const fold = target?.closest("details");
    if (fold && !fold.open) {
      fold.open = true;
      target.scrollIntoView();
    }
  }
  addEventListener("hashchange", unfold);
  unfold();

  // Paper cannot be unfolded.
  addEventListener("beforeprint", () => {
    for (const fold of document.querySelectorAll("details")) fold.open = true;
  });
})();
