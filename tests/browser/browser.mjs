// What the tests share: a page in headless Chromium, which tells of every request and of everything on its console.

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const AXE = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
const PAGES = process.env.AIM_BATCH_PAGES;
export const PAGE_OF = {
  bench: path.join(PAGES, "bench/index.html"),
  small: path.join(PAGES, "small/report/index.html"),
  large: path.join(PAGES, "large/report/index.html"),
};

let browser = null;

export async function start() {
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM, args: ["--no-sandbox", "--disable-gpu"] });
}

export async function stop() {
  await browser.close();
}

/** Opens a page from disk. `asked` collects its requests but the page itself, `said` what its console and errors say. */
export async function open(file, { width = 1400, height = 1000, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, reducedMotion: "reduce", ...options });
  const page = await context.newPage();
  const [asked, said] = [[], []];
  const own = pathToFileURL(file).href;
  page.on("request", (request) => {
    const url = request.url();
    if (url !== own && !url.startsWith("data:")) asked.push(url);
  });
  page.on("console", (message) => said.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => said.push(`error: ${error.message}`));
  page.on("dialog", (dialog) => {
    said.push(`dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  await page.goto(own);
  return { page, asked, said, close: () => context.close() };
}

/** Asserts that axe-core finds nothing serious. It runs from outside the page's policy. */
export async function assertAccessible(page, place) {
  const axe = await import("node:fs").then((fs) => fs.readFileSync(AXE, "utf8"));
  await page.evaluate(axe);
  const found = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
  const serious = found.violations.filter(({ impact }) => impact === "serious" || impact === "critical");
  const told = serious.map(({ id, help, nodes }) => `${id}: ${help}\n  ${nodes.slice(0, 3).map((node) => `${node.html.slice(0, 200)} ${node.failureSummary}`).join("\n  ")}`);
  assert.deepEqual(told, [], place);
}

/** The texts of a column of a table, counted from 0. */
export async function column(page, table, place) {
  return page.$$eval(`${table} tbody tr:not(.summary)`, (rows, at) => rows.map((row) => row.cells[at].textContent.trim()), place);
}
