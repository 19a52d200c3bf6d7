#!/usr/bin/env python3
"""A spall whose edges and floor vary across the track: a topography, and the scene that runs with it.

    python examples/rough_spall.py [--edges 0.1] [--floor 1.0] [--seed 1] [-o target/rough]
    cargo fmu run target/rough/6205-rough-spall.toml

The spall of 6205-spall-5deg, 5 degrees and 15 um, as a grid of depths over arc and width. Each edge wanders along the
raceway by `--edges` mm, and the floor goes up and down by `--floor` um (root mean squares), over 0.25 mm: invented, for
no such surface was at hand. A measured one has the same three columns. With both at 0 it is the spall of straight
edges.
"""

import argparse
from pathlib import Path

import numpy as np
from bearing import SCENES, changed_scene, whole

BASE, NAME = SCENES / "6205-spall-5deg.toml", "6205-rough-spall"
RADIUS_MM = 23.4925  # outer raceway of a 6205 with 5 um of clearance
LENGTH_DEG, DEPTH_UM = 5.0, 15.0  # of 6205-spall-5deg
WAVE_MM = 0.25  # assumed: a few grains' breakouts; the contact is some 0.8 mm wide
HALF_WIDTH_MM = 1.2  # wider than the contact under any load here
FLANK_MM = 0.03  # an edge goes down over this way: half a contact's length
ARC_STEP_MM, AXIAL_STEP_MM = 0.0075, 0.1  # not more than a cell of the contact grid along the raceway


def wandering(random, points, step):
    """Values along lines in all of the grid's directions, of root mean square 1, alike over WAVE_MM."""
    way = [np.arange(-int(3 * WAVE_MM / one), int(3 * WAVE_MM / one) + 1) * one for one in step]
    values = random.standard_normal(points)
    for axis, at in enumerate(way):
        weights = np.exp(-0.5 * (at / (0.5 * WAVE_MM)) ** 2)
        weights /= np.sqrt(np.sum(weights**2))
        # Repeated at its ends, so that the root mean square is the same everywhere.
        around = [(len(at), len(at)) if other == axis else (0, 0) for other in range(values.ndim)]
        padded = np.pad(values, around, mode="wrap")
        smooth = np.apply_along_axis(lambda line: np.convolve(line, weights, "same"), axis, padded)
        values = smooth.take(range(len(at), len(at) + points[axis]), axis)
    return values


def topography(edges_mm, floor_um, seed):
    """Arcs and axial coordinates [mm], and depths [um] over both."""
    random = np.random.default_rng(seed)
    half = 0.5 * LENGTH_DEG * np.pi / 180 * RADIUS_MM
    reach = half + 4 * edges_mm + 2 * FLANK_MM
    arc = np.arange(-np.ceil(reach / ARC_STEP_MM), np.ceil(reach / ARC_STEP_MM) + 1) * ARC_STEP_MM
    axial = np.arange(-round(HALF_WIDTH_MM / AXIAL_STEP_MM), round(HALF_WIDTH_MM / AXIAL_STEP_MM) + 1) * AXIAL_STEP_MM
    leading, trailing = (half + edges_mm * wandering(random, (len(axial),), (AXIAL_STEP_MM,)) for _ in range(2))
    floor = DEPTH_UM + floor_um * wandering(random, (len(arc), len(axial)), (ARC_STEP_MM, AXIAL_STEP_MM))
    # 0 at the edge, 1 where the flank has reached the floor.
    inside = np.minimum(arc[:, None] + leading, trailing - arc[:, None])
    return arc, axial, np.maximum(floor, 0.0) * np.clip(inside / FLANK_MM, 0.0, 1.0)


def profile(folder, edges_mm, floor_um, seed, name=NAME):
    """Writes a topography; gives what it changes in 6205-spall-5deg. A map of 1 % takes a minute of a core."""
    arc, axial, depth = topography(edges_mm, floor_um, seed)
    path = Path(folder) / f"{name}-topography.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    with whole(path) as part, open(part, "w", encoding="utf-8", newline="\n") as file:
        print(f"# Invented: rough_spall.py, edges {edges_mm:g} mm, floor {floor_um:g} um, seed {seed}", file=file)
        print("arc_mm,axial_mm,depth_um", file=file)
        for i, j in np.ndindex(depth.shape):
            print(f"{arc[i]:.4f},{axial[j]:.1f},{depth[i, j]:.3f}", file=file)
    gone = dict.fromkeys(["defect.length_deg", "defect.depth_um", "defect.edge_slope_deg"])
    return {**gone, "defect.profile": path.name, "contact.map_accuracy": 0.01}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--edges", type=float, default=0.1, help="wandering of the edges [mm]")
    parser.add_argument("--floor", type=float, default=1.0, help="unevenness of the floor [um]")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("-o", "--output", default="target/rough")
    options = parser.parse_args()
    changes = profile(options.output, options.edges, options.floor, options.seed)
    print(changed_scene(BASE, NAME, changes, options.output))


if __name__ == "__main__":
    main()
