"""What `simulate_fmu` gives of each FMU, as a checksum of all its bits.

Arguments: folder to unpack into, stop time [s], FMUs. Prints platform, then name, points, columns and SHA-256.
"""

import hashlib
import sys
from pathlib import Path

import fmpy

folder, stop = Path(sys.argv[1]), float(sys.argv[2])
print(fmpy.platform)
for file in map(Path, sys.argv[3:]):
    unpacked = folder / f"{file.stem} entpackt für später (50 % + ß)"
    fmpy.extract(str(file), str(unpacked))
    result = fmpy.simulate_fmu(str(unpacked), stop_time=stop, output_interval=1e-4)
    print(file.name, len(result), len(result.dtype.names), hashlib.sha256(result.tobytes()).hexdigest())
