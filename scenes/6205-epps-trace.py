"""Writes 6205-epps-trace.csv, a stand-in for a measured trace that was never published.

The trace of Epps' etched spall (SKF 6205, 0.8 mm long) is not public; only its length is taken from the literature.
Everything else here is assumed: a floor 40 um deep, so deep that an element of 7.94 mm, which sinks 17 um into 0.8 mm,
does not reach it; flanks that lose this depth within 8 um; a floor roughness of 1.5 um rms that is correlated over some
12 um, as etching leaves it; smooth raceway beside it. The noise comes from a seeded generator written out below, so
every run writes the same bytes.

    python3 scenes/6205-epps-trace.py > scenes/6205-epps-trace.csv
"""

SPACING_UM = 4  # assumed; a stylus or an optical profiler resolves 2 to 5 um
LENGTH_UM = 800  # published
LEAD_UM = 40  # assumed: smooth raceway on either side
FLANK_UM = 8  # assumed
DEPTH_UM = 40.0  # assumed
ROUGHNESS_UM = 1.5  # assumed, rms
CORRELATION = 3  # assumed, in points


def noise(count, seed=6205):
    """Sums of twelve uniform numbers, variance 1, from a linear congruential generator (Numerical Recipes'
    constants)."""
    state = seed
    values = []
    for _ in range(count):
        total = 0
        for _ in range(12):
            state = (1664525 * state + 1013904223) % 2**32
            total += state
        values.append(total / 2**32 - 6.0)
    return values


def main():
    half = LENGTH_UM // 2
    arcs = range(-half - LEAD_UM, half + LEAD_UM + 1, SPACING_UM)
    white = noise(len(arcs) + CORRELATION - 1)
    # The moving mean of n numbers of variance 1 has the variance 1/n.
    rough = [sum(white[i : i + CORRELATION]) / CORRELATION**0.5 for i in range(len(arcs))]
    print("# STAND-IN, not a measurement: written by 6205-epps-trace.py, which says what is assumed.")
    print("# Spall of 0.8 mm on the outer raceway of a 6205; depth positive into the ring.")
    print("arc_mm,depth_um")
    for arc, height in zip(arcs, rough):
        inside = half - abs(arc)
        share = min(max(inside / FLANK_UM, 0.0), 1.0)
        depth = share * DEPTH_UM + (ROUGHNESS_UM * height if share == 1.0 else 0.0)
        print(f"{arc / 1000:.3f},{depth:.2f}")


if __name__ == "__main__":
    main()
