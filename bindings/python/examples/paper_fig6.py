"""The paper's Fig. 6: four members with 30 g at the tip turn by pi rad in 2 s.

python paper_fig6.py [picture.png]
"""

import sys

import matplotlib.pyplot as plt

import stillbeam as sb

# An illustration: the paper fits its damping to its experiments and does not print it.
DAMPING = {"alpha": 0.15, "beta": 0.002}

figure, panels = plt.subplots(4, 2, sharex=True, figsize=(10, 9), layout="constrained")
for member, (left, right) in zip("abcd", panels):
    scene = sb.Scene.from_toml(f"{member}-tip30")
    for style, name, arm in (
        ("-", "undamped", scene),
        ("--", "damped", scene.replace(damping=DAMPING)),
    ):
        run = sb.run(arm, method="newmark")
        left.plot(run.time, run.tip_x, style, label=name)
        right.plot(run.time, 1e3 * run.deflection, style, label=name)
        print(
            f"member {member.upper()}, {name}: peak {100 * abs(run.deflection).max() / scene.length:.2f},"
            f" residual {100 * run.residual:.2f} % of L"
        )
    left.set_ylabel(f"{member.upper()}: tip X, m")
    right.set_ylabel("deflection, mm")
    for panel in (left, right):
        panel.axvline(2.0, color="grey", linestyle=":")
        panel.grid(True, alpha=0.3)
panels[0, 0].legend()
for panel in panels[-1]:
    panel.set_xlabel("time, s")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "paper_fig6.png", dpi=110)
