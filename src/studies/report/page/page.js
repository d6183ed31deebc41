"use strict";
// The page is complete without this script. It adds search, choices and sorting to tables, and a slider to pictures.
(() => {
  const LONG = 12; // rows from which a table gets search and choices
  const CHOICES = 8; // most different texts of a column that become choices

  const add = (parent, tag, properties = {}, text = "") => {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(text);
    parent.append(element);
    return element;
  };
  const textOf = (row, column) => (row.cells[column]?.textContent ?? "").trim();
  // Numbers have commas between thousands, and marks may follow them.
  const numberOf = (text) => {
    const plain = text.replace(/,/g, "");
    const infinite = /^(-?)inf/.exec(plain);
    return infinite ? Number(`${infinite[1]}Infinity`) : parseFloat(plain);
  };

  const sortable = (table, rows) => {
    const body = table.tBodies[0];
    const heads = [...table.tHead.rows[0].cells];
    heads.forEach((head, column) => {
      const button = add(head, "button", { type: "button", className: "sort", title: "Sort" });
      button.append(...[...head.childNodes].filter((node) => node !== button));
      button.onclick = () => {
        const order = { ascending: "descending", descending: null }[head.ariaSort ?? ""];
        const next = order === undefined ? "ascending" : order;
        heads.forEach((other) => { other.ariaSort = null; });
        head.ariaSort = next;
        const numeric = rows.some((row) => row.cells[column]?.classList.contains("number"));
        const compare = (a, b) => {
          const [x, y] = [textOf(a, column), textOf(b, column)];
          if (!numeric) { return x.localeCompare(y); }
          const [m, n] = [numberOf(x), numberOf(y)];
          return Number.isNaN(m) || Number.isNaN(n) ? Number.isNaN(m) - Number.isNaN(n) : (m > n) - (m < n);
        };
        const sign = next === "descending" ? -1 : 1;
        body.append(...(next ? [...rows].sort((a, b) => sign * compare(a, b)) : rows));
      };
    });
  };

  const filtered = (table, rows) => {
    const bar = document.createElement("form");
    bar.className = "filter";
    bar.onsubmit = () => false;
    table.parentElement.before(bar);
    const search = add(bar, "input", { type: "search", placeholder: "Search", ariaLabel: `Search ${table.caption.textContent}` });
    const choices = [...table.tHead.rows[0].cells].flatMap((head, column) => {
      const texts = [...new Set(rows.map((row) => textOf(row, column)).filter(Boolean))].sort();
      const isNumber = rows.some((row) => row.cells[column]?.classList.contains("number"));
      if (isNumber || texts.length < 2 || texts.length > CHOICES) { return []; }
      const label = add(bar, "label", {}, `${head.textContent} `);
      const select = add(label, "select");
      add(select, "option", { value: "" }, "all");
      texts.forEach((text) => add(select, "option", { value: text }, text));
      return [{ column, select }];
    });
    const shown = add(bar, "output");
    const apply = () => {
      const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
      let count = 0;
      rows.forEach((row) => {
        const text = `${row.id} ${row.textContent}`.toLowerCase();
        const chosen = choices.every(({ column, select }) => !select.value || textOf(row, column) === select.value);
        row.hidden = !(chosen && words.every((word) => text.includes(word)));
        count += row.hidden ? 0 : 1;
      });
      shown.textContent = `${count} of ${rows.length} rows`;
    };
    bar.addEventListener("input", apply);
    // A link to a row shows it.
    const follow = () => {
      const row = document.getElementById(decodeURIComponent(location.hash.slice(1)));
      if (row?.hidden && table.contains(row)) {
        bar.reset();
        apply();
        row.scrollIntoView();
      }
    };
    window.addEventListener("hashchange", follow);
    apply();
  };

  // Shows two pictures one over the other; the second is visible to the right of a border that follows the pointer.
  const compare = (pictures) => {
    const dialog = add(document.body, "dialog", { className: "compare" });
    const bar = add(dialog, "form");
    const stage = add(dialog, "div", { className: "stage" });
    const sides = [0, 1].map((side) => {
      const image = add(stage, "img", { alt: "" });
      const select = add(add(bar, "label", {}, side === 0 ? "Left " : "Right "), "select");
      pictures.forEach(({ alt }, n) => add(select, "option", { value: n, selected: n === side }, alt));
      select.onchange = () => { image.src = pictures[select.value].src; };
      select.onchange();
      return image;
    });
    const range = add(bar, "input", { type: "range", min: 0, max: 100, step: 0.1, value: 50, ariaLabel: "Border" });
    const move = () => { sides[1].style.clipPath = `inset(0 0 0 ${range.value}%)`; };
    range.oninput = move;
    stage.onpointermove = (event) => {
      const { left, width } = stage.getBoundingClientRect();
      range.value = (100 * (event.clientX - left)) / width;
      move();
    };
    const close = add(bar, "button", { type: "button" }, "Close");
    close.onclick = () => dialog.close();
    dialog.onclose = () => dialog.remove();
    const { width, height } = pictures[0];
    const room = Math.min(0.9 * innerWidth / width, 0.75 * innerHeight / height);
    stage.style.width = `${width * (room < 1 ? room : Math.floor(room))}px`;
    move();
    dialog.showModal();
  };

  document.querySelectorAll(".figures").forEach((group) => {
    const all = [...group.querySelectorAll("img")].map((image) => {
      const { alt, src } = image;
      return { alt, src, width: Number(image.getAttribute("width")), height: Number(image.getAttribute("height")) };
    });
    const pictures = all.filter(({ width, height }) => width === all[0].width && height === all[0].height);
    if (pictures.length < 2) { return; }
    const button = document.createElement("button");
    Object.assign(button, { type: "button", className: "slide", textContent: "Compare two with a slider" });
    button.onclick = () => compare(pictures);
    group.after(button);
  });
  window.addEventListener("keydown", ({ key }) => {
    const close = key === "Escape" && document.querySelector(".picture:target > .close");
    if (close) { location.hash = close.hash; }
  });

  document.querySelectorAll(".scroll > table").forEach((table) => {
    const rows = [...table.tBodies[0].rows];
    // A row that represents several rows must stay below the row that it equals.
    if (rows.length < 2 || rows.some((row) => row.classList.contains("folded"))) { return; }
    if (rows.length >= LONG) { filtered(table, rows); }
    sortable(table, rows);
  });
})();
