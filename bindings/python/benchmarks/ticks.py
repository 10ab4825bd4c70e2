"""How many ticks a second `run` makes: whole trajectories, arrays included, of processor time.

pip install ./bindings/python
python bindings/python/benchmarks/ticks.py
"""

import time

import stillbeam as sb

scene = sb.Scene.from_toml("d-tip30-quick")
# A million ticks each: ten thousand rounds there and back in a second, and one turn by
# microseconds.
path = scene.replace(move={"waypoints": [[0.4, 1.0], [1.0, 0.0]], "repeat": 10_000})
turn = scene.replace(move={"profile": "quintic", "duration": 0.7, "to": 3.0, "settle": 0.3})

print("| method | path of 20000 rows | one turn |\n| --- | ---: | ---: |")
for keywords in (
    {"method": "rigid"},
    {"method": "newmark"},
    {"method": "modal"},
    {"method": "elastica", "quality": "fast"},
    {"method": "elastica", "quality": "fine"},
):
    rates = []
    for motion, tick in ((path, 0.01), (turn, 1e-6)):
        seconds = []
        for _ in range(3):
            begin = time.process_time()
            run = sb.run(motion, tick=tick, **keywords)
            seconds.append(time.process_time() - begin)
        rates.append(1e-6 * len(run) / min(seconds))
    method = run.method.replace(", 0.001 ms", "")
    print(f"| {method} | {rates[0]:.2f} | {rates[1]:.2f} |")
