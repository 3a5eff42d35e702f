// What the page of a study of 10,000 measurements and 50,000 images costs a reader. Limits leave room for a busy machine.

import assert from "node:assert/strict";
import fs from "node:fs";
import { after, before, it } from "node:test";
import { PAGE_OF, open, start, stop } from "./browser.mjs";

before(start);
after(stop);

it("a bench is below 10 MB, in one file", () => {
  assert.ok(fs.statSync(PAGE_OF.bench).size < 10e6);
});

it("a large study opens and answers at once", async (test) => {
  const { page, close } = await open(PAGE_OF.large);
  const { loaded, nodes } = await page.evaluate(() => ({
    loaded: performance.getEntriesByType("navigation")[0].loadEventEnd,
    nodes: document.querySelectorAll("*").length,
  }));
  const took = (act) => page.evaluate(async (text) => {
    const begun = performance.now();
    const [kind, selector, value] = text;
    const one = document.querySelector(selector);
    if (kind === "click") one.click();
    else {
      one.value = value;
      one.dispatchEvent(new Event("input"));
    }
    await new Promise((painted) => requestAnimationFrame(() => setTimeout(painted)));
    return performance.now() - begun;
  }, act);
  const sorted = await took(["click", "#measurements-table thead th:nth-child(8) button"]);
  const filtered = await took(["input", "#measurements-table input[type=search]", "p1 plate"]);
  const opened = await took(["click", "#measurements-table tbody button"]);
  const bytes = fs.statSync(PAGE_OF.large).size;
  const ms = (number) => `${number.toFixed(0)} ms`;
  test.diagnostic(`${bytes} bytes, loaded in ${ms(loaded)}, ${nodes} nodes; sorted in ${ms(sorted)}, filtered in ${ms(filtered)}, row opened in ${ms(opened)}`);
  assert.ok(loaded < 5000 && nodes < 15000, `${loaded} ms, ${nodes} nodes`);
  assert.ok(Math.max(sorted, filtered, opened) < 1000, `${sorted}, ${filtered}, ${opened} ms`);
  await close();
});
