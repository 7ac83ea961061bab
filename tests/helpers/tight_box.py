"""The tight box about a shape of the CAD kernel, by which tests compare shapes with meshes."""

import numpy as np


def bounds(shape):
    """Lowest and highest corner (2, 3)."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, box, False, False)
    return np.array([box.CornerMin().Coord(), box.CornerMax().Coord()])
