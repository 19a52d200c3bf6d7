"""The FMI cross-check as fmpy does it: files after the rules, and the results found again. Folder, names of FMUs."""

import shutil
import sys
from pathlib import Path

import numpy as np
from fmpy import platform, read_csv, simulate_fmu
from fmpy.cross_check import validate_result
from fmpy.cross_check.validate_vendor_repo import validate_test_fmu
from fmpy.util import read_ref_opt_file


def found_again(fmu, stem):
    """Options of a reference run beside `stem`, after its results were found again, and what is said of that."""
    options, reference = read_ref_opt_file(f"{stem}_ref.opt"), read_csv(f"{stem}_ref.csv")
    outputs = reference.dtype.names[1:]
    start, stop, step = (options[key] for key in ("StartTime", "StopTime", "StepSize"))
    assert reference["time"][0] == start and reference["time"][-1] == stop and 3 <= len(outputs) <= 10, fmu
    result = simulate_fmu(
        str(fmu), stop_time=stop, step_size=step, output_interval=step, output=list(outputs),
        relative_tolerance=options["RelTol"], input=read_csv(f"{stem}_in.csv"),
    )  # fmt: skip
    problem = validate_result(result, reference, start, stop)
    assert problem is None, (fmu, problem)
    # Before impacts magnify the rounding of communication points, far more is the same than the cross-check's band of a
    # tenth: each signal within 1e-6 of its range over the first 10 ms.
    early = reference["time"] < 0.01
    apart = {}
    for output in outputs:
        size = max(np.ptp(reference[output]), 1e-3 * np.abs(reference[output]).max(), 1e-12)
        apart[output] = np.abs(result[output][early] - reference[output][early]).max() / size
    worst = max(apart, key=apart.get)
    assert apart[worst] < 1e-6, (fmu, worst, apart[worst])
    # The check can fail: a cage that turns the other way is not the reference.
    reference["cage.angle"] *= -1
    assert validate_result(result, reference, start, stop) is not None, fmu
    told = f"{len(outputs)} outputs, {len(reference)} rows, first 10 ms within {apart[worst]:.1e} ({worst})"
    return options, told


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    for name in sys.argv[2:]:
        # The folders of the cross-check's repository, which the checks read off the path.
        there = folder / "fmus" / "2.0" / "cs" / platform / "Brinell" / "0.0" / name
        there.mkdir(parents=True)
        for end in (".fmu", "_ref.csv", "_ref.opt", "_in.csv"):
            shutil.copy(folder / f"{name}{end}", there)
        problems = validate_test_fmu(str(there))
        assert not problems, problems
        _, told = found_again(there / f"{name}.fmu", there / name)
        print(f"{name}: {told}")
