"""The same swing with Exudyn's Python model and with stillbeam: lines, seconds, error.

    pip install ./bindings/python exudyn==1.13.6
    python bindings/python/benchmarks/exudyn_swing.py

Scene d-tip30-quick: a strip of 0.4 m with 30 g at its tip, whose hub turns by pi rad in 0.51 s
along a quintic. Errors are the tip's largest distance from stillbeam's reference rod, over the whole run,
at every 10 ms.
"""

import inspect
import time

import numpy as np

import stillbeam as sb

LENGTH, MASS, EI, EA, PAYLOAD = 0.4, 0.0224, 0.46, 1.38e6, 0.03
ANGLE, DURATION, END = np.pi, 0.51, 0.81


def with_exudyn(elements, step):
    import exudyn as exu
    from exudyn.beams import GenerateBeamElementsAlongLine
    from exudyn.utilities import (
        Cable2D,
        CoordinateConstraint,
        MarkerNodeCoordinate,
        MassPoint2D,
        NodePointGround,
        SensorNode,
    )

    system = exu.SystemContainer()
    mbs = system.AddSystem()
    cable = Cable2D(
        physicsMassPerLength=MASS / LENGTH,
        physicsBendingStiffness=EI,
        physicsAxialStiffness=EA,
    )
    beam = GenerateBeamElementsAlongLine(
        mbs, [0, 0, 0], [LENGTH, 0, 0], elements, cable, groundConstraintsStart=[1, 1, 0, 0]
    )
    nodes = beam["nodes"]
    mbs.AddObject(MassPoint2D(mass=PAYLOAD, nodeNumber=nodes[-1]))

    def angle(t):
        s = min(t / DURATION, 1.0)
        return ANGLE * s**3 * (10.0 - 15.0 * s + 6.0 * s * s)

    # The clamp turns: the slope of the first node is (cos, sin) of the hub's angle.
    ground = mbs.AddMarker(
        MarkerNodeCoordinate(nodeNumber=mbs.AddNode(NodePointGround()), coordinate=0)
    )
    slopes = (
        (2, lambda mbs, t, n, c: np.cos(angle(t)) - 1.0),
        (3, lambda mbs, t, n, c: np.sin(angle(t))),
    )
    for coordinate, offset in slopes:
        slope = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=nodes[0], coordinate=coordinate))
        mbs.AddObject(
            CoordinateConstraint(markerNumbers=[ground, slope], offsetUserFunction=offset)
        )
    sensor = mbs.AddSensor(
        SensorNode(
            nodeNumber=nodes[-1],
            outputVariableType=exu.OutputVariableType.Position,
            storeInternal=True,
        )
    )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = END
    settings.timeIntegration.numberOfSteps = round(END / step)
    settings.timeIntegration.adaptiveStep = False
    settings.timeIntegration.newton.absoluteTolerance = 1e-7
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = step
    settings.timeIntegration.verboseMode = 0
    mbs.SolveDynamic(settings)
    return mbs.GetSensorStoredData(sensor)[:, :3]


def with_stillbeam(tick):
    scene = sb.Scene(
        link={"length": LENGTH, "mass": MASS, "bending_stiffness": EI},
        payload={"mass": PAYLOAD},
        move={"profile": "quintic", "duration": DURATION, "to": ANGLE, "settle": 0.3},
    )
    run = sb.run(scene, method="elastica", tick=tick)
    return np.column_stack([run.time, run.tip_x, run.tip_y])


def timed(work, *arguments):
    """Return the result, and the shortest of three times of the processor, s."""
    times = []
    for _ in range(3):
        begin = time.process_time()
        result = work(*arguments)
        times.append(time.process_time() - begin)
    return result, min(times)


def lines(work):
    """Return the lines of a function that are neither blank, comment nor its imports."""
    text = inspect.getsource(work).splitlines()[1:]
    code = [line.strip() for line in text if line.strip() and not line.strip().startswith("#")]
    if "from exudyn.utilities import (" in code:
        code = code[code.index(")") + 1 :]
    return len(code)


def judge():
    """Return the tip of the reference rod at every 10 ms: time, x, y."""
    rod = sb.reference(sb.Scene.from_toml("d-tip30-quick"))
    return np.column_stack([rod.time, rod.tip_x, rod.tip_y])[:82]


def error(rows, wanted):
    """Return the largest distance of the tip from where it is wanted, in % of the length."""
    at = [int(np.argmin(abs(rows[:, 0] - t))) for t in wanted[:, 0]]
    assert np.allclose(rows[at, 0], wanted[:, 0], atol=1e-7)
    return 100 * np.hypot(*(rows[at, 1:] - wanted[:, 1:]).T).max() / LENGTH


def main():
    wanted = judge()
    print("| model | lines | ms | tip error, % of L |\n| --- | ---: | ---: | ---: |")
    cases = [
        ("stillbeam, elastica, 2 modes, 10 ms", with_stillbeam, (0.01,)),
        ("stillbeam, elastica, 2 modes, 1 ms", with_stillbeam, (0.001,)),
    ]
    for elements, step in ((4, 1e-3), (8, 1e-3), (8, 1e-4), (16, 1e-4)):
        name = f"Exudyn, {elements} ANCF cables, generalised alpha, {1e3 * step:g} ms"
        cases.append((name, with_exudyn, (elements, step)))
    for name, work, arguments in cases:
        rows, seconds = timed(work, *arguments)
        figures = f"{lines(work)} | {float(f'{1e3 * seconds:.2g}'):g} | {error(rows, wanted):.4f}"
        print(f"| {name} | {figures} |")


if __name__ == "__main__":
    main()
