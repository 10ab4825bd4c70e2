"""A still move against input shapers: what is left if the arm's frequency is not what was thought.

    python still_against_shapers.py [picture.png]

Every motion takes the same time, shapers included, and is judged by the reference rod.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import stillbeam as sb

scene = sb.Scene.from_toml("d-tip30")
period = scene.describe()["period_s"][0]
stiffness, angle, duration = 0.46, np.pi / 2, 0.6
errors = np.linspace(-0.2, 0.2, 9)

# A shaper makes a motion longer by so many periods: the motion before it is shorter by as much.
shapers = {None: 0.0, "zv": 1 / 2, "mzv": 2 / 3, "zvd": 1.0, "ei": 1.0}

figure, panel = plt.subplots(figsize=(8, 5), layout="constrained")
for kind, periods in shapers.items():
    ticks = int((duration - periods * period) / scene.tick)
    shaper = kind and {"kind": kind, "frequency": 1 / period, "damping": 0.0}
    move = {
        "profile": "quintic",
        "duration": ticks * scene.tick,
        "from": 0.0,
        "to": angle,
        "settle": 0.4,
    }
    left = []
    for error in errors:
        real = {"bending_stiffness": stiffness * (1 + error) ** 2}
        left.append(sb.reference(scene.replace(link=real, move=move, shaper=shaper)).residual)
    name = f"quintic, {kind.upper()}" if kind else "quintic"
    panel.plot(100 * errors, 100 * np.array(left), marker="o", label=name)
    print(f"{name:24} " + " ".join(f"{100 * x:7.3f}" for x in left))

for robust in (None, 0.2):
    plan = sb.plan(scene, angle, duration=duration, robust=robust)
    name = "still" if robust is None else f"still, robust to ±{100 * robust:.0f} %"
    panel.plot(100 * plan.frequency_error, 100 * plan.residual_at_error, label=name, linewidth=2)
    at = np.interp(errors, plan.frequency_error, plan.residual_at_error)
    print(f"{name:24} " + " ".join(f"{100 * x:7.3f}" for x in at))

panel.set_yscale("log")
panel.set_xlabel("error of the arm's frequency, %")
panel.set_ylabel("residual vibration, % of L")
panel.set_title(f"a quarter turn in {duration} s, {duration / period:.1f} first periods")
panel.grid(True, alpha=0.3)
panel.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "still_against_shapers.png", dpi=110)
