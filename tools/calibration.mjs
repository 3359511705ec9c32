// Writes assets/kickboxing/CALIBRATION.md from what `ringcraft library check --json` says (stdin):
//   ringcraft library check --json | node tools/calibration.mjs > assets/kickboxing/CALIBRATION.md
import { readFileSync } from "node:fs";

const check = JSON.parse(readFileSync(0, "utf8"));
const n = (x, digits = 2) => Number(x).toFixed(digits);
const file = (a) => a.source.split(":")[0];
const authored = check.actions.filter((a) => a.authored);

// The figures that the sheets of a file follow (validation V1, V2, V4; calibration sections 1-6).
const follows = {
  "punches.toml":
    "median key poses of captured jabs, crosses, body hooks, a rear uppercut and a lead hook; V1: straights 7-11 m/s at the fist, hooks faster",
  "kicks.toml":
    "captured mid roundhouse and thrust (chamber, support pivot, way back 2-4 times longer); V1: roundhouse 11-14 m/s, 40-50 % over the front kick, 0.4-0.6 s",
  "combinations.toml": "contact to contact 0.19-0.31 s from jab to cross and jab to jab (captured)",
  "defenses.toml": "a head's radius and a fist's, 0.17 m, off the line; no captured slips",
  "steps.toml": "captured steps: 0.21-0.27 s, 0.12 [0.04..0.26] H, 2-4 cm lift, nearer foot first",
  "switch.toml": "the steps' lift and times; no captured change of stance",
  "responses.toml": "V2: recovery steps start at 0.2-0.3 s and land at 0.4-0.6 s, 0.3-0.5 m",
  "falls.toml": "captured fall and get-ups: hips before trunk, head last, pause in the squat",
  "close.toml": "hooks and the front kick with the forearm or the shin folded; no captured elbows, knees or shoves",
  "spins.toml":
    "a captured side thrust kick (pelvis turned 60-77 degrees, hip tilted 27-32); head first, then body, limb last; no captured spins or sweeps",
  "guard.toml": "medians of two captured guards, 26 s",
};

// What the sheets say may follow, the actions that say the same on one line; most of them first.
function leads(actions) {
  const by = new Map();
  for (const a of actions) {
    const words = a.may_lead_to.join(", ") || "whatever begins where it ends";
    by.set(words, [...(by.get(words) ?? []), a.name]);
  }
  const groups = [...by].sort((x, y) => y[1].length - x[1].length);
  return groups.map(
    ([words, names], i) => `${i === 0 ? "May lead to" : `- ${names.join(", ")}:`} ${words}${i === 0 ? "." : ""}`,
  );
}

const lines = [
  "# What the kickboxing sheets follow and measure",
  "",
  "Written by `ringcraft library check --json | node tools/calibration.mjs`; not by hand. Speeds are in the",
  "world at the knuckles, instep, ball of the foot or heel, on a standing body of the same size whose guard",
  "is left out: from where the blow lands fastest, and from where it meets what it aims at.",
  "",
  "## Gates",
  "",
  "| figure | is | asked |",
  "|---|---|---|",
  ...check.gates.map(
    (g) => `| ${g.name} | ${n(g.value)} ${g.unit}${g.passed ? "" : " (fails)"} | ${g.least} to ${g.most} |`,
  ),
];
for (const name of [...new Set(authored.map(file))].sort()) {
  lines.push("", `## ${name}`, "", `Follows ${follows[name] ?? "no figures"}.`, "");
  lines.push("| action | s | travel m | turn deg | head m | inside itself mm | still hands % | leads directly to |");
  lines.push("|---|---|---|---|---|---|---|---|");
  for (const a of authored.filter((x) => file(x) === name)) {
    lines.push(
      `| ${a.name} | ${n(a.seconds)} | ${n(a.travel_m)} | ${n((a.turn_rad * 180) / Math.PI, 0)} | ${n(a.head_moves_m)} | ${n(1000 * a.self_penetration_m, 0)} | ${n(100 * a.still_hands, 0)} | ${a.leads_to} |`,
    );
  }
  lines.push("", ...leads(authored.filter((x) => file(x) === name)));
  const names = new Set(authored.filter((x) => file(x) === name).map((a) => a.name));
  const strikes = check.strikes.filter((s) => names.has(s.action));
  if (strikes.length === 0) continue;
  lines.push("", "| strike | lands m/s | aimed m/s | after s | peak at | brake/push | links ms | aim | from m |");
  lines.push("|---|---|---|---|---|---|---|---|---|");
  for (const s of strikes) {
    const links = `${n(1000 * s.pelvis_to_chest_s, 0)}, ${n(1000 * s.chest_to_limb_s, 0)}`;
    lines.push(
      `| ${s.action} ${s.number + 1}, ${s.kind} | ${n(s.impact_mps, 1)} | ${n(s.impact_aimed_mps, 1)} | ${n(s.start_to_contact_s)} | ${n(s.peak_fraction)} | ${n(s.brake_mps2 / Math.max(1, s.push_mps2), 1)} | ${links} | ${s.aim || "-"} | ${n(s.aim_from_m)}-${n(s.aim_to_m)} |`,
    );
  }
}
process.stdout.write(`${lines.join("\n")}\n`);
