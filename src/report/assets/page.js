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

  // One cursor for all: where the mouse is in a picture over time, over x or by layer, the same moment is marked in the others; a
  // click brings the playback there. Without the mouse the mark is where the playback is.
  function shareCursor() {
    const player = window.vcutPlayback;
    const areas = [...document.querySelectorAll("[data-cursor]")].map(area);
    if (player === undefined) return;
    const words = [...document.querySelectorAll("figure .tools")].map((tools) => {
      const told = document.createElement("output");
      tools.prepend(told);
      return told;
    });
    let pointed = null;

    /** A stretch of a picture, with the line in it. */
    function area(rect) {
      const svg = rect.ownerSVGElement;
      const [left, top, width, height] = ["x", "y", "width", "height"].map((name) => Number(rect.getAttribute(name)));
      const { cursor, from, to, layers } = rect.dataset;
      const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
      line.setAttribute("class", "cursor");
      if (cursor !== "layers") svg.append(line);
      return {
        svg, rect, line, cursor, left, top, width, height,
        from: Number(from), to: Number(to), layers: layers === undefined ? [] : layers.split(" "),
      };
    }

    /** The moment that is meant by a place in a picture; none beside what it shows. */
    function meant({ svg, cursor, left, top, width, height, from, to, layers }, event) {
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
      if (at.x < left || at.x > left + width || at.y < top || at.y > top + height) return null;
      const value = from + ((at.x - left) / width) * (to - from);
      if (cursor === "time") return value;
      return cursor === "x" ? player.timeOfCutAt(value) : player.timeOfLayers(layers);
    }

    function show() {
      const moment = player.momentAt(pointed ?? player.time());
      for (const { line, rect, cursor, left, top, width, height, from, to, layers } of areas) {
        if (cursor === "layers") {
          rect.classList.toggle("cursor-row", layers.includes(moment.layer));
          continue;
        }
        const value = cursor === "time" ? moment.time : moment.x;
        const at = left + ((value - from) / (to - from)) * width;
        line.setAttribute("d", value >= from && value <= to ? `M${at.toFixed(2)} ${top}v${height}` : "");
      }
      for (const told of words) told.textContent = pointed === null ? "" : moment.words;
    }

    for (const svg of new Set(areas.map((one) => one.svg))) {
      const here = areas.filter((one) => one.svg === svg);
      const find = (event) => here.map((one) => meant(one, event)).find((time) => time !== null) ?? null;
      let pressed = null;
      svg.addEventListener("pointermove", (event) => {
        pointed = find(event);
        show();
      });
      svg.addEventListener("pointerleave", () => {
        pointed = null;
        show();
      });
      svg.addEventListener("pointerdown", (event) => {
        pressed = { x: event.clientX, y: event.clientY };
      });
      // Where the picture holds the pointer, the click is the picture's frame's.
      svg.closest(".view").addEventListener("click", (event) => {
        const moved = pressed === null || Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > 4;
        pressed = null;
        const time = moved ? null : find(event);
        if (time !== null) player.seek(time);
      });
    }
    for (const button of document.querySelectorAll("[data-seek]")) {
      button.addEventListener("click", () => {
        player.seek(Number(button.dataset.seek));
        document.getElementById("playback").scrollIntoView();
      });
    }
    document.addEventListener("vcut-playback", show);
    show();
  }
  shareCursor();

  /** Marks what goes on to the right of what is seen of it. */
  function hint(box) {
    box.classList.toggle("more", box.scrollLeft + box.clientWidth < box.scrollWidth - 1);
  }
  const sized = new ResizeObserver((changes) => changes.forEach(({ target }) => hint(target)));
  for (const box of document.querySelectorAll(".wide")) {
    box.addEventListener("scroll", () => hint(box), { passive: true });
    sized.observe(box);
  }

  // Of sections at several y the one that the slider points at is shown, in all drawings of the picture.
  const slides = [...document.querySelectorAll("[data-slide]")];
  function slideTo(number) {
    for (const figure of slides) {
      for (const part of figure.querySelectorAll("[data-section]")) {
        if (Number(part.dataset.section) === number) part.removeAttribute("display");
        else part.setAttribute("display", "none");
      }
      const shown = figure.querySelector(`[data-section="${number}"]`);
      figure.querySelector("input").value = number;
      figure.querySelector("output").textContent = shown?.dataset.y ?? "";
    }
  }
  for (const figure of slides) {
    figure.querySelector("input").addEventListener("input", (event) => slideTo(Number(event.target.value)));
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

  // Paper cannot be unfolded. Of the cuts each layer has a line.
  addEventListener("beforeprint", () => {
    for (const fold of document.querySelectorAll("details:not(.cuts details)")) fold.open = true;
  });
})();
