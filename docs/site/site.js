// Search, the menu on small screens, copy buttons. Pages work without it. It runs from file://, where fetch does not work.
"use strict";
(() => {
  const root = document.body.dataset.root;
  const input = document.getElementById("search");
  const found = document.getElementById("found");
  let entries = null;
  let chosen = -1;

  // ---- Search ----

  // The index is a script that calls this function; it is loaded when the search field gets the focus.
  window.burnishIndex = (rows) => {
    entries = rows.map(([title, address, kind, page, text]) => ({
      title, address, kind, page, text,
      low: { title: title.toLowerCase(), text: text.toLowerCase(), page: page.toLowerCase() },
    }));
    search();
  };
  function loadIndex() {
    if (document.getElementById("index")) return;
    const script = document.createElement("script");
    script.id = "index";
    script.src = root + "index.js";
    document.head.append(script);
  }

  // Position of a word in a text, preferably at the start of a word; null if it does not occur.
  function position(text, word) {
    for (let at = text.indexOf(word); at >= 0; at = text.indexOf(word, at + 1)) {
      if (at === 0 || !/[a-z0-9]/.test(text[at - 1])) return { at, start: true };
    }
    const at = text.indexOf(word);
    return at < 0 ? null : { at, start: false };
  }

  const STOP_WORDS = new Set("a an and are as at be by can do does for from how i in is it of on or the this to what when where which why with you".split(" "));

  // The words of a query, without stop words; misspelled words are corrected, and unknown ones dropped if others remain.
  function wordsOf(query) {
    const words = query.toLowerCase().split(/\s+/).filter(Boolean);
    const kept = words.filter((word) => !STOP_WORDS.has(word));
    const known = kept.map(corrected).filter(Boolean);
    return known.length ? known : kept.length ? kept : words;
  }

  // The word; if no page has it, a word of the pages with one letter more or less, changed or swapped; else undefined.
  let vocabulary = null;
  function corrected(word) {
    if (entries.some(({ low }) => low.title.includes(word) || low.text.includes(word))) return word;
    vocabulary ??= new Set(entries.flatMap(({ low }) => `${low.title} ${low.text}`.match(/[a-z]{4,}/g) ?? []));
    return [...vocabulary].find((other) => isNear(word, other));
  }
  function isNear(a, b) {
    if (Math.abs(a.length - b.length) > 1) return false;
    let i = 0;
    while (i < a.length && a[i] === b[i]) ++i;
    const [restA, restB] = [a.slice(i), b.slice(i)];
    return restA.slice(1) === restB || restA === restB.slice(1) || restA.slice(1) === restB.slice(1) ||
      (restA[0] === restB[1] && restA[1] === restB[0] && restA.slice(2) === restB.slice(2));
  }

  // All words must occur. Flags and titles count more than text, complete titles most.
  function score(entry, words) {
    let total = 0;
    for (const word of words) {
      const title = position(entry.low.title, word);
      const text = position(entry.low.text, word);
      const page = position(entry.low.page, word);
      if (!title && !text && !page) return 0;
      if (title) total += (title.start ? 60 : 25) + 40 * word.length / entry.title.length;
      if (entry.low.title.match(/^--([a-z-]+)/)?.[1] === word.replace(/^--/, "")) total += 200;
      if (page) total += entry.address.includes("#") ? 6 : 20;
      if (text) total += (text.start ? 10 : 3) + (entry.address.includes("#") ? 0 : 5) + 4 / (1 + text.at / 200); // a page's summary first
    }
    const whole = words.join(" ");
    if (entry.low.title === whole) total += 120;
    if (entry.low.text.includes(whole) && words.length > 1) total += 15;
    return entry.page === "Changes" ? total / 3 : total;
  }

  function escape(text) {
    return text.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
  }
  function marked(text, words) {
    const pattern = words.map((word) => word.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")).join("|");
    return text.split(new RegExp(`(${pattern})`, "i")).map((part, i) => i % 2 ? `<mark>${escape(part)}</mark>` : escape(part)).join("");
  }
  function excerpt(entry, words) {
    const hit = words.map((word) => position(entry.low.text, word)).find((at) => at);
    const from = hit && hit.at > 60 ? entry.text.lastIndexOf(" ", hit.at - 40) + 1 : 0;
    return (from ? "… " : "") + entry.text.slice(from, from + 180);
  }

  function choose(index) {
    const links = found.querySelectorAll("a");
    chosen = links.length ? (index + links.length) % links.length : -1;
    links.forEach((link, i) => link.setAttribute("aria-selected", String(i === chosen)));
    if (chosen >= 0) {
      links[chosen].scrollIntoView({ block: "nearest" });
      input.setAttribute("aria-activedescendant", links[chosen].id);
    } else {
      input.removeAttribute("aria-activedescendant");
    }
  }
  function close() {
    found.hidden = true;
    input.setAttribute("aria-expanded", "false");
  }
  function search() {
    if (!input.value.trim() || !entries) return close();
    const words = wordsOf(input.value);
    const best = entries.map((entry) => ({ entry, score: score(entry, words) })).filter((x) => x.score > 0)
      .sort((a, b) => b.score - a.score).slice(0, 20);
    found.innerHTML = best.map(({ entry }, i) => `<a role="option" tabindex="-1" id="found-${i}" href="${root}${entry.address}">` +
      `<small>${escape(entry.address.includes("#") ? entry.page : entry.kind)}</small><b>${marked(entry.title, words)}</b><p>${marked(excerpt(entry, words), words)}</p></a>`)
      .join("") || '<p class="none">No section has all of these words.</p>';
    found.hidden = false;
    input.setAttribute("aria-expanded", "true");
    choose(0);
  }
  input.addEventListener("focus", loadIndex);
  input.addEventListener("input", search);
  input.addEventListener("focus", search);
  input.addEventListener("keydown", (event) => {
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      choose(chosen + (event.key === "ArrowDown" ? 1 : -1));
    } else if (event.key === "Enter" && chosen >= 0 && !found.hidden) {
      found.querySelectorAll("a")[chosen].click();
      close();
      input.blur();
    } else if (event.key === "Escape") {
      close();
      input.blur();
    } else {
      return;
    }
    event.preventDefault();
  });
  document.addEventListener("click", (event) => {
    if (!event.target.closest(".search") || event.target.closest("#found a")) close();
  });
  document.addEventListener("keydown", (event) => {
    const typing = /^(INPUT|TEXTAREA|SELECT)$/.test(document.activeElement.tagName);
    if (event.key === "/" && !typing && !event.ctrlKey && !event.metaKey && !event.altKey) {
      input.focus();
      event.preventDefault();
    }
  });

  // ---- The menu ----

  const menu = document.querySelector(".menu");
  document.body.classList.add("scripted");
  menu.setAttribute("aria-expanded", "false");
  menu.setAttribute("aria-controls", "pages");
  function open(wanted) {
    document.body.classList.toggle("menu-open", wanted);
    menu.setAttribute("aria-expanded", String(wanted));
    menu.textContent = wanted ? "Close" : "Menu";
  }
  menu.addEventListener("click", (event) => {
    event.preventDefault();
    open(!document.body.classList.contains("menu-open"));
  });
  menu.addEventListener("keydown", (event) => {
    if (event.key === " ") menu.click(), event.preventDefault();
  });
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape") open(false);
  });
  const here = document.querySelector(".pages [aria-current]");
  const list = document.querySelector(".pages");
  if (here && here.offsetTop > list.clientHeight) list.scrollTop = here.offsetTop - list.clientHeight / 2;

  // ---- Code ----

  // Code and formulas that scroll can be scrolled with the keyboard.
  const blocks = [...document.querySelectorAll("main pre, main math[display='block'], main p:has(> math)")];
  function focusScrolling() {
    for (const [block, scrolls] of blocks.map((block) => [block, block.scrollWidth > block.clientWidth])) {
      if (scrolls) block.setAttribute("tabindex", "0");
      else block.removeAttribute("tabindex");
    }
  }
  addEventListener("resize", focusScrolling);
  focusScrolling();


  for (const pre of document.querySelectorAll("main pre.sourceCode")) {
    const button = document.createElement("button");
    button.className = "copy";
    button.type = "button";
    button.textContent = "Copy";
    button.addEventListener("click", async () => {
      await navigator.clipboard.writeText(pre.textContent.trimEnd() + "\n").then(() => "Copied", () => "Not allowed").then((label) => (button.textContent = label));
      setTimeout(() => (button.textContent = "Copy"), 1500);
    });
    pre.parentNode.append(button);
  }

  // ---- The current section ----

  const links = new Map([...document.querySelectorAll(".contents a")].map((a) => [decodeURIComponent(a.hash.slice(1)), a]));
  const headings = [...links.keys()].map((id) => document.getElementById(id)).filter(Boolean);
  let now = null;
  function follow() {
    const passed = headings.filter((heading) => heading.getBoundingClientRect().top < 120).pop();
    const link = passed && links.get(passed.id);
    if (link === now) return;
    if (now) now.classList.remove("now");
    if (link) link.classList.add("now");
    now = link;
    const box = document.querySelector(".contents");
    if (link && box.scrollHeight > box.clientHeight) box.scrollTop = link.offsetTop - box.clientHeight / 2;
  }
  if (headings.length) {
    addEventListener("scroll", () => requestAnimationFrame(follow), { passive: true });
    follow();
  }
})();
