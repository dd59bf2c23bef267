# Shows NAME.pvd in ParaView as spheres of the right size, coloured by speed.
#
#   cd to this folder, then: paraview --script=NAME-in-paraview.py
#
# By hand: open NAME.pvd, Apply; Filters > Glyph: type Sphere, radius 0.5, no
# orientation, scale array "diameter", scale factor 1, all points; Apply.
import os
from paraview.simple import *

# ParaView's window does not tell a script where it lies, only where ParaView was started.
folder = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.getcwd()
path = os.path.join(folder, "NAME.pvd")
if not os.path.exists(path):
    raise RuntimeError("start ParaView in the folder that holds NAME.pvd")
grains = PVDReader(registrationName="NAME", FileName=path)
view = GetActiveViewOrCreate("RenderView")
spheres = Glyph(registrationName="spheres", Input=grains, GlyphType="Sphere")
spheres.GlyphType.Radius = 0.5
spheres.GlyphType.ThetaResolution = 16
spheres.GlyphType.PhiResolution = 16
spheres.OrientationArray = ["POINTS", "No orientation array"]
spheres.ScaleArray = ["POINTS", "diameter"]
spheres.ScaleFactor = 1.0
spheres.GlyphMode = "All Points"
display = Show(spheres, view)
ColorBy(display, ("POINTS", "velocity", "Magnitude"))
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
view.CameraFocalPoint = [0.0, 0.0, 0.0]
view.CameraPosition = [0.3, -1.0, 0.3]
view.CameraViewUp = [0.0, 0.0, 1.0]
view.ResetCamera()
Render()
