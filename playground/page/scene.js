// The scene file of a motion, as `stillbeam-sim run` reads it.

import { digits, float } from "./number.js";

/** Returns the text of the scene file. `run` tells the duration that a shaper leaves. */
export function sceneFile(kind, settings, si, facts, run, stiffness) {
  const tables = [link(kind, settings, si, stiffness)];
  tables.push(`[payload]\nmass = ${float(si.payload)}`);
  if (si.damping > 0) {
    tables.push(`[damping]\n# A ratio of ${settings.damping} % in the first mode.\nbeta = ${float(facts.beta)}`);
  }
  tables.push(move(kind, settings, si, facts, run));
  if (kind === "shaped") {
    tables.push(
      `[shaper]\nkind = "${settings.shaper}"\nfrequency = ${float(facts.frequency)}\ndamping = ${float(facts.ratio)}`,
    );
  }
  tables.push(`[solver]\nmethod = "elastica"`);
  return `${tables.join("\n\n")}\n`;
}

function link(kind, settings, si, stiffness) {
  const lines = [
    "[link]",
    `length = ${float(si.length)}`,
    `material = "${settings.material}"`,
    `width = ${float(si.width)}`,
    `thickness = ${float(si.thickness)}`,
  ];
  if (si.error !== 0) {
    lines.push(
      `# The arm in the picture has frequencies that differ by ${settings.error} %. With this line the file`,
      kind === "still" ? "# is of that arm, and the still move is planned for it:" : "# is of that arm:",
      `# bending_stiffness = ${float(stiffness)}`,
    );
  }
  return lines.join("\n");
}

function move(kind, settings, si, facts, run) {
  const lines = ["[move]", `profile = "${kind === "still" ? "still" : "cubic"}"`];
  if (kind === "shaped") lines.push(`# ${digits(settings.duration)} s with the shaper.`);
  lines.push(`duration = ${float(kind === "shaped" ? run.duration : si.duration)}`);
  if (kind === "still" && settings.robust !== "0") lines.push(`robust = ${settings.robust}`);
  lines.push("from = 0.0", `to = ${float(si.angle)}  # ${settings.angle} degrees`, `settle = ${float(facts.rest)}`);
  return lines.join("\n");
}
