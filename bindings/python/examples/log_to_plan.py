"""From a log to a plan: an arm that is softer than its data sheet, tapped, identified, planned for.

    python log_to_plan.py [picture.png]

The log is made here by the reference rod, with noise; one of your own is read by
``sb.identify("tap.csv", scene=documented)``.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import stillbeam as sb

documented = sb.Scene.from_toml("d-tip30").replace(move=None)
# What nobody knows: the link is 15 % softer than documented, and its vibration dies out.
real = documented.replace(
    link={"bending_stiffness": 0.85 * 0.46}, damping={"ratio": 0.006, "from": "beta"}
)

# Log: the swing after a small turn of the real arm, every 5 ms, with half a millimetre of noise.
nudge = {"profile": "quintic", "duration": 0.2, "to": 0.1, "settle": 5.0}
swing = sb.reference(real.replace(move=nudge), every=0.005)
after = swing.time > 0.2
noise = np.random.default_rng(1).normal(0.0, 5e-4, after.sum())
log = {"t_s": swing.time[after], "tip_deflection_m": swing.deflection[after] + noise}

found = sb.identify(log, scene=documented, modes=1)
mode, truth = found.modes[0], real.describe()
print(
    f"identified {mode.frequency_hz:.4f} Hz and {mode.damping_ratio:.4f},"
    f" true {truth['frequency_hz'][0]:.4f} Hz and {truth['damping_ratio'][0]:.4f}"
)

# Plans: the same turn for the arm as documented and as identified, carried out by the real one.
figure, panels = plt.subplots(2, 1, figsize=(8, 7), layout="constrained")
panels[0].plot(found.panels[0].time, 1e3 * found.panels[0].measured, label="log", linewidth=0.7)
panels[0].plot(found.panels[0].time, 1e3 * found.panels[0].fitted, label="fitted", linewidth=0.7)
panels[0].set_title(
    f"the log: {mode.frequency_hz:.3f} Hz, {100 * mode.damping_ratio:.2f} % damping"
)
for name, arm in (("as documented", documented), ("as identified", found.scene)):
    plan = sb.plan(arm, 1.57, start=0.0, duration=0.6)
    motion = {"waypoints": plan.waypoints(), "profile": "quintic", "settle": 0.6}
    run = sb.reference(real.replace(move=motion))
    panels[1].plot(run.time, 1e3 * run.deflection, label=f"planned {name}")
    print(f"planned {name}: {100 * run.residual:.3f} % of L are left")
panels[1].axvline(0.6, color="grey", linestyle=":")
panels[1].set_title("still moves, carried out by the real arm")
for panel in panels:
    panel.set_xlabel("time, s")
    panel.set_ylabel("deflection, mm")
    panel.grid(True, alpha=0.3)
    panel.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "log_to_plan.png", dpi=110)
