// The page as its readers have it: opened from disk, with mouse and with keyboard, light and dark, wide and narrow.

import assert from "node:assert/strict";
import { after, before, describe, it } from "node:test";
import { PAGE_OF, assertAccessible, column, open, start, stop } from "./browser.mjs";

before(start);
after(stop);

describe("every page", () => {
  for (const [name, file] of Object.entries(PAGE_OF)) {
    it(`${name} opens from disk, asks for nothing, and says nothing`, async () => {
      const { page, asked, said, close } = await open(file);
      assert.equal(await page.locator("h1").count(), 1);
      assert.ok((await page.locator("#measurements-table tbody tr").count()) > 10);
      assert.deepEqual(asked, []);
      assert.deepEqual(said, []);
      await close();
    });

    for (const colorScheme of ["light", "dark"]) {
      it(`${name} has nothing serious for axe-core, ${colorScheme}`, async () => {
        const { page, close } = await open(file, { colorScheme, bypassCSP: true });
        await page.$$eval("details", (all) => all.forEach((one) => (one.open = true)));
        await assertAccessible(page, "page");
        await page.locator("#measurements-table tbody button").first().click();
        await assertAccessible(page, "with a row open");
        await close();
      });
    }

    it(`${name} fits 420 px: only frames of tables scroll sideways`, async () => {
      const { page, close } = await open(file, { width: 420, height: 860 });
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 420);
      await close();
    });
  }
});

describe("the checks themselves", () => {
  it("see a defect and a request", async () => {
    const { page, asked, said, close } = await open(PAGE_OF.small, { bypassCSP: true });
    await page.evaluate(() => {
      document.querySelector("main").insertAdjacentHTML("beforeend", "<img src='none.png'><p style='color:#ccc;background:#fff'>pale</p>");
    });
    await assert.rejects(assertAccessible(page, "page"), /color-contrast[\s\S]*image-alt/);
    assert.equal(asked.length, 1);
    assert.equal(said.length, 1);
    await close();
  });

  it("are not needed to stop a script: the policy does", async () => {
    const { page, said, close } = await open(PAGE_OF.small);
    const stopped = [];
    page.on("requestfailed", (request) => stopped.push(`${request.url()} ${request.failure().errorText}`));
    const ran = await page.evaluate(async () => {
      const script = document.createElement("script");
      script.textContent = "globalThis.broken = true";
      document.body.append(script);
      document.body.insertAdjacentHTML("beforeend", "<img src='https://example.invalid/a.png' onerror='globalThis.broken = true'>");
      await new Promise((done) => setTimeout(done, 200));
      return globalThis.broken;
    });
    // Its own handler, which a name might bring along, is stopped as well.
    assert.equal(ran, undefined);
    assert.deepEqual(stopped, ["https://example.invalid/a.png csp"], "stopped before it left");
    assert.ok(said.length > 0 && said.every((line) => line.includes("Content Security Policy")), said.join("\n"));
    await close();
  });
});

describe("tables", () => {
  it("sort upwards, downwards, and back", async () => {
    const { page, close } = await open(PAGE_OF.bench);
    const table = "table[aria-labelledby=table_II-caption]";
    const heading = page.locator(`${table} thead th`, { hasText: "predicted" }).first();
    const at = await heading.evaluate((cell) => cell.cellIndex);
    const before = await column(page, table, at);
    const numbers = async () => (await column(page, table, at)).map(Number);
    const ascending = before.map(Number).sort((a, b) => a - b);
    await heading.locator("button").click();
    assert.equal(await heading.getAttribute("aria-sort"), "ascending");
    assert.deepEqual(await numbers(), ascending);
    await heading.locator("button").press("Enter");
    assert.equal(await heading.getAttribute("aria-sort"), "descending");
    assert.deepEqual(await numbers(), [...ascending].reverse());
    await heading.locator("button").click();
    assert.deepEqual(await column(page, table, at), before);
    assert.equal(await heading.getAttribute("aria-sort"), "none");
    await close();
  });

  it("filter, and say how many rows are left", async () => {
    const { page, close } = await open(PAGE_OF.bench);
    const article = page.locator("article", { has: page.locator("#table_II-caption") });
    await article.getByLabel("Filter rows").fill("small");
    const objects = await column(page, "table[aria-labelledby=table_II-caption]", 0);
    assert.ok(objects.length > 0 && objects.every((object) => object.includes("small")), objects.join());
    assert.match(await article.getByRole("status").innerText(), new RegExp(`^${objects.length} of \\d+ rows`));
    await close();
  });

  it("show misprints as notes that their marks lead to", async () => {
    const { page, close } = await open(PAGE_OF.bench);
    const mark = page.locator("#tables sup a").first();
    const note = page.locator(await mark.getAttribute("href"));
    await mark.click();
    assert.ok((await note.innerText()).length > 10);
    assert.ok(await note.evaluate((one) => one.matches(":target")));
    await close();
  });
});

describe("measurements", () => {
  it("are chosen by lists, words and magnitude, and turn pages", async () => {
    const { page, close } = await open(PAGE_OF.large);
    const [table, count] = ["#measurements-table table", page.locator("#measurements-table [role=status]")];
    assert.equal(await count.innerText(), "10,400 rows");
    assert.equal(await page.locator(`${table} tbody tr`).count(), 100);
    await page.locator("#measurements-table").getByRole("button", { name: "Next" }).click();
    assert.match(await page.locator(".pager", { hasText: "of 104" }).innerText(), /Page 2 of 104/);
    await page.locator("#measurements-table select[name=rater]").selectOption({ label: "ben" });
    assert.equal(await count.innerText(), "5,200 of 10,400 rows");
    await page.locator("#measurements-table").getByLabel("Filter rows").fill("p007 SOUP");
    assert.equal(await count.innerText(), "13 of 10,400 rows");
    const heading = page.locator(`${table} thead th`, { hasText: "error" });
    await heading.locator("button").click();
    await heading.locator("button").click();
    const at = await heading.evaluate((cell) => cell.cellIndex);
    const errors = (await column(page, table, at)).map((text) => Math.abs(Number(text.replace("\u2212", "-"))));
    assert.equal(errors.length, 13);
    assert.deepEqual(errors, [...errors].sort((a, b) => b - a), "largest error first, whatever its sign");
    await close();
  });

  it("open a picture with its marks by click; arrows go on, Escape goes back", async () => {
    const { page, said, close } = await open(PAGE_OF.small);
    const viewer = page.locator("#viewer");
    await page.locator("#measurements-table tbody tr").nth(1).locator("td").first().click();
    await viewer.waitFor();
    const picture = viewer.locator("img");
    assert.ok(await picture.evaluate((image) => image.decode().then(() => image.naturalWidth > 0)));
    assert.match(await picture.getAttribute("alt"), /^As taken: .*with rim of <b>bowl<\/b> & "cup" by <i>ben<\/i>$/);
    assert.equal(await viewer.locator(".mark.line").count(), 1, "the row's own mark");
    assert.ok((await viewer.locator(".mark.other").count()) > 0, "those of others");
    assert.match(await viewer.locator("h2").innerText(), /row 2 of 168/);
    await page.keyboard.press("ArrowRight");
    assert.match(await viewer.locator("h2").innerText(), /row 3 of 168/);
    await page.keyboard.press("m");
    assert.equal(await viewer.locator(".mark").count(), 0);
    await page.keyboard.press("+");
    assert.equal(await viewer.locator(".stage").evaluate((stage) => stage.style.width), "150%");
    await page.keyboard.press("Escape");
    assert.equal(await viewer.isVisible(), false);
    assert.deepEqual(said, []);
    await close();
  });

  it("of a run show its pictures, in three views for some", async () => {
    const { page, asked, close } = await open(PAGE_OF.bench);
    const views = page.locator("#examples img");
    assert.ok((await views.count()) >= 3);
    const isThere = async (image) => {
      await image.scrollIntoViewIfNeeded();
      return image.evaluate((one) => one.decode().then(() => one.naturalWidth > 100));
    };
    assert.ok(await isThere(views.first()));
    await page.locator("#measurements-table tbody button").first().click();
    assert.ok(await isThere(page.locator("#viewer img")));
    assert.ok((await page.locator("#viewer .mark.line").count()) > 0);
    assert.deepEqual(asked, [], "all of them are in the page");
    await close();
  });

  it("open by keyboard alone, in any view, and give the focus back", async () => {
    const { page, close } = await open(PAGE_OF.small);
    const first = page.locator("#measurements-table tbody button").first();
    await first.focus();
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("ArrowUp");
    await page.keyboard.press("Enter");
    const viewer = page.locator("#viewer");
    await viewer.waitFor();
    await viewer.locator("select").selectOption({ index: 2 });
    assert.match(await viewer.locator("img").getAttribute("alt"), /^On the table plane/);
    await page.keyboard.press("Escape");
    assert.ok(await first.evaluate((button) => button === document.activeElement));
    await close();
  });

  it("show pictures beside the page where they are many, and ask for nothing else", async () => {
    const { page, asked, said, close } = await open(PAGE_OF.large);
    await page.locator("#measurements-table").getByRole("button", { name: "Pictures" }).click();
    assert.equal(await page.locator(".sheet li").count(), 100);
    const image = page.locator(".sheet img").first();
    await image.scrollIntoViewIfNeeded();
    assert.ok(await image.evaluate((one) => one.decode().then(() => one.naturalWidth > 0)));
    await page.locator(".sheet button").nth(4).click();
    assert.match(await page.locator("#viewer h2").innerText(), /row 5 of/);
    assert.ok(asked.length > 0 && asked.every((url) => url.includes("/large/report/pictures/")), asked.join());
    assert.deepEqual(said, []);
    await close();
  });
});

describe("looks", () => {
  const paper = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);

  it("follow the system, or the button", async () => {
    const light = await open(PAGE_OF.bench, { colorScheme: "light" });
    const dark = await open(PAGE_OF.bench, { colorScheme: "dark" });
    const [white, black] = [await paper(light.page), await paper(dark.page)];
    assert.notEqual(white, black);
    const button = dark.page.locator("#theme");
    await button.click();
    assert.equal(await button.innerText(), "Colours: light");
    assert.equal(await paper(dark.page), white);
    await button.click();
    assert.equal(await paper(dark.page), black);
    await light.close();
    await dark.close();
  });

  it("print to PDF with every section open", async () => {
    const { page, close } = await open(PAGE_OF.bench);
    await page.emulateMedia({ media: "print" });
    const pdf = await page.pdf({ format: "A4" });
    assert.equal(pdf.subarray(0, 5).toString(), "%PDF-");
    const pages = pdf.toString("latin1").match(/\/Type\s*\/Page\b/g).length;
    assert.ok(pages > 3 && pages < 100, `${pages} pages`);
    await close();
  });

  it("fold, and open again for a link", async () => {
    const { page, close } = await open(PAGE_OF.bench);
    const section = page.locator("#sessions");
    await section.locator("summary").click();
    assert.equal(await section.evaluate((one) => one.open), false);
    await page.locator(".contents a", { hasText: "Sessions" }).click();
    assert.equal(await section.evaluate((one) => one.open), true);
    await close();
  });

  it("read without the script", async () => {
    const { page, close } = await open(PAGE_OF.bench, { javaScriptEnabled: false });
    assert.ok(await page.locator("#table_II-caption").isVisible());
    assert.ok(await page.locator("noscript").isVisible());
    assert.equal(await page.locator("#theme").isVisible(), false);
    await close();
  });
});
