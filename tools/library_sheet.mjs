// Contact sheets of a library's actions, for looking at many at once: the filmstrips of the page that
// `ringcraft library inspect` writes, two abreast, as numbered PNG files.
//   node tools/library_sheet.mjs LIBRARY_HTML OUT_FOLDER [--per 24] [--only REGEXP] [--width 760]
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { parseArgs } from "node:util";
import { launch } from "../viewer/browser.mjs";

const USAGE = "usage: node library_sheet.mjs LIBRARY_HTML OUT_FOLDER [--per 24] [--only REGEXP] [--width 760]";

function fail(message) {
  console.error(`${message}\n${USAGE}`);
  process.exit(2);
}

function options() {
  try {
    const { values, positionals } = parseArgs({
      allowPositionals: true,
      options: {
        per: { type: "string", default: "24" },
        only: { type: "string", default: "" },
        width: { type: "string", default: "760" },
      },
    });
    if (positionals.length !== 2) throw new Error("give the page and a folder");
    const per = Number(values.per), width = Number(values.width);
    if (!(per >= 1 && per <= 60)) throw new Error("--per: 1 to 60");
    if (!(width >= 200 && width <= 3000)) throw new Error("--width: 200 to 3000 pixels");
    return { page: positionals[0], out: positionals[1], per, width, only: new RegExp(values.only) };
  } catch (error) {
    return fail(error.message);
  }
}

const { page, out, per, width, only } = options();
if (!existsSync(page)) fail(`${page}: no such file; make it with \`ringcraft library inspect --out FOLDER\``);

// Each action's filmstrip carries its name as the first text of its picture.
const films = readFileSync(page, "utf8")
  .split('<div class="film"')
  .slice(1)
  .map((part) => /<svg[\s\S]*?<\/svg>/.exec(part)?.[0] ?? "")
  .filter((svg) => only.test(/<text[^>]*>\s*([\w-]+)/.exec(svg)?.[1] ?? ""));
if (films.length === 0) fail(`no action of ${page} is called /${only.source}/`);

mkdirSync(out, { recursive: true });
const browser = await launch();
try {
  const tab = await browser.newPage({ viewport: { width: 2 * width + 12, height: 600 } });
  for (let i = 0; i * per < films.length; ++i) {
    // The strips give a size but no view box, without which they would be cut off, not scaled.
    const shown = films.slice(i * per, (i + 1) * per).map((svg) =>
      svg.replace(/width='(\d+)' height='(\d+)'/, "viewBox='0 0 $1 $2'"));
    const style = `body{margin:4px;display:grid;grid-template-columns:1fr 1fr;gap:2px;background:#fff}svg{width:${width}px;height:auto}`;
    await tab.setContent(`<!doctype html><style>${style}</style>${shown.join("\n")}`);
    const file = path.join(out, `library_${String(i + 1).padStart(2, "0")}.png`);
    writeFileSync(file, await tab.screenshot({ fullPage: true }));
    console.log(file);
  }
} finally {
  await browser.close();
}
