// The scene file, the link and the table, to take along.

import { KINDS } from "./cards.js";

export class Share {
  /** `text(kind)` returns the scene file of a motion, `run(kind)` its run or a refusal. */
  constructor(text, run) {
    Object.assign(this, { text, run, kind: "still" });
    const group = document.querySelector("#kinds");
    for (const { kind } of KINDS) {
      const label = document.createElement("label");
      label.innerHTML = `<input type="radio" name="kind" value="${kind}"> ${kind}`;
      const input = label.querySelector("input");
      input.checked = kind === this.kind;
      input.addEventListener("change", () => {
        this.kind = kind;
        this.show();
      });
      group.append(label);
    }
    const on = (id, action) => document.querySelector(id).addEventListener("click", action);
    on("#copy-scene", () => this.copy(this.text(this.kind), "Scene copied"));
    on("#copy-link", () => this.copy(location.href, "Link copied"));
    on("#save-csv", () => this.save());
  }

  show() {
    document.querySelector("#toml").textContent = this.text(this.kind);
    document.querySelector("#save-csv").disabled = this.run(this.kind).refusal !== undefined;
  }

  async copy(text, done) {
    try {
      await navigator.clipboard.writeText(text);
      this.say(done);
    } catch {
      this.say("The browser does not let the page copy; select the text instead");
    }
  }

  save() {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([this.run(this.kind).csv()], { type: "text/csv" }));
    link.download = `${this.kind}.csv`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    this.say("Saved");
  }

  say(words) {
    const output = document.querySelector("#done");
    output.textContent = words;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      output.textContent = "";
    }, 4000);
  }
}
