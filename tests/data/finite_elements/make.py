#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the files of this folder anew: a small C-frame of cast iron in CalculiX (package calculix-ccx), and the same
result as files of VTK (package python3-vtk9). Units mm, K. States at 900, 1800, 2700 and 3600 s:
  1  the whole machine is 10 K warmer                 u = 1.1e-5 * 10 * (x - x1), x1 = (0, 0, 0)
  2  20 K warmer                                      twice that
  3  not warmer, but turned by 1e-4 rad about X at its support
  4  the front of the column (small y) is 8 K warmer, the rear is not: it leans back
usage: ./make.py"""
import os, shutil, subprocess, tempfile

here = os.path.dirname(os.path.abspath(__file__))
size, nodes, elements = 100.0, {}, []
# Boxes of 100 mm: bed and table at y = 0 ... 2, column at y = 3 ... 4, head over the table at the top.
filled = {(i, j, 0) for i in range(2) for j in range(5)} | {(i, j, k) for i in range(2) for j in (3, 4) for k in range(1, 6)}
filled |= {(i, j, 5) for i in range(2) for j in (1, 2)} | {(0, 1, 4), (1, 1, 4)}


def node(i, j, k):
    return nodes.setdefault((i, j, k), len(nodes) + 1)


for i, j, k in sorted(filled):
    elements.append([node(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
place = {n: tuple(size * v for v in key) for key, n in nodes.items()}
sets = {"TOOL": [n for n, p in place.items() if p[2] == 400 and p[1] in (100, 200)],
        "TABLE": [n for n, p in place.items() if p[2] == 100 and p[1] in (100, 200)],
        "EDGE": [n for n, p in place.items() if p[2] == 100 and p[1] == 0]}
sets["OBSERVED"] = sorted(set(sets["TOOL"]) | set(sets["TABLE"]))


def lines(numbers):
    return "".join(", ".join(map(str, numbers[at:at + 12])) + ",\n" for at in range(0, len(numbers), 12))


mesh = "** units mm\n*NODE, NSET=ALL\n" + "".join("%d, %g, %g, %g\n" % (n, *p) for n, p in place.items())
mesh += "*ELEMENT, TYPE=C3D8I, ELSET=IRON\n" + "".join("%d, %s\n" % (e + 1, ", ".join(map(str, l))) for e, l in enumerate(elements))
for name, list_ in sets.items():
    mesh += "*NSET, NSET=%s\n%s" % (name, lines(list_))
mesh += "*NSET, NSET=FIRST_TEN, GENERATE\n1, 10\n*NSET, NSET=BOTH\nTOOL, EDGE\n"
foot = [node(0, 0, 0), node(2, 0, 0), node(0, 5, 0)]
turn = {n: (0.0, -1e-4 * place[n][2], 1e-4 * place[n][1]) for n in foot}
dofs = [(foot[0], (1, 2, 3)), (foot[1], (2, 3)), (foot[2], (1, 3))]
deck = "*INCLUDE, INPUT=mesh.inp\n*MATERIAL, NAME=IRON\n*ELASTIC\n1.15e5, 0.28\n*EXPANSION, ZERO=0.\n1.1e-5\n"
deck += "*SOLID SECTION, ELSET=IRON, MATERIAL=IRON\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 0.\n"
for k in range(4):
    deck += "*STEP\n*STATIC\n900., 900.\n*BOUNDARY, OP=NEW\n"
    for n, list_ in dofs:
        deck += "".join("%d, %d, %d, %.10g\n" % (n, d, d, turn[n][d - 1] if k == 2 else 0.0) for d in list_)
    deck += "*TEMPERATURE, OP=NEW\n"
    for n, p in place.items():
        warm = 8.0 * (5 - p[1] / 100) / 2 if p[1] >= 300 and p[2] > 100 else 0.0
        deck += "%d, %g\n" % (n, (10.0, 20.0, 0.0, warm)[k])
    deck += "*NODE PRINT, NSET=OBSERVED\nU\n*NODE FILE\nU, NT\n*END STEP\n"
work = tempfile.mkdtemp()
open(work + "/mesh.inp", "w").write(mesh)
open(work + "/frame.inp", "w").write(deck)
subprocess.run(["ccx", "-i", "frame"], cwd=work, check=True, stdout=subprocess.DEVNULL, env={**os.environ, "OMP_NUM_THREADS": "1"})
shutil.copy(work + "/mesh.inp", here)
for f in ("frame.frd", "frame.dat"):
    shutil.copy(f"{work}/{f}", here)

import vtkmodules.all as vtk  # noqa: E402
from vtkmodules.util.vtkConstants import VTK_HEXAHEDRON  # noqa: E402

states, state = [], None
for line in open(work + "/frame.frd"):
    if line[:6] == "  100C": time = float(line[12:24])
    if line.startswith(" -4"): state = {} if line.split()[1] == "DISP" else None; state is not None and states.append((time, state))
    if line.startswith(" -1") and state is not None: state[int(line[3:13])] = [float(line[13 + 12 * i:25 + 12 * i]) for i in range(3)]
collection = ""
for at, (time, state) in enumerate(states):
    grid, points, u, ids, tool = vtk.vtkUnstructuredGrid(), vtk.vtkPoints(), vtk.vtkDoubleArray(), vtk.vtkIntArray(), vtk.vtkIntArray()
    points.SetDataTypeToDouble()
    u.SetName("U"), u.SetNumberOfComponents(3), ids.SetName("node_id"), tool.SetName("TOOL")
    for n in sorted(place):
        points.InsertNextPoint(place[n]), u.InsertNextTuple3(*state[n]), ids.InsertNextValue(n), tool.InsertNextValue(int(n in sets["TOOL"]))
    grid.SetPoints(points)
    for e in elements:
        cell = vtk.vtkIdList()
        for n in e: cell.InsertNextId(n - 1)
        grid.InsertNextCell(VTK_HEXAHEDRON, cell)
    for array in (u, ids, tool): grid.GetPointData().AddArray(array)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(f"{here}/frame_{at + 1}.vtu"), writer.SetInputData(grid), writer.SetDataModeToBinary(), writer.Write()
    collection += '    <DataSet timestep="%g" part="0" file="frame_%d.vtu"/>\n' % (time, at + 1)
open(here + "/frame.pvd", "w").write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n  <Collection>\n' + collection + "  </Collection>\n</VTKFile>\n")
shutil.rmtree(work)
