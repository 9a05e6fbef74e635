# SPDX-License-Identifier: BSD-3-Clause
"""Files of a mesh as VTK's own readers give them."""
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader


def grid_of(file):
    """The grid of a .pvtu or a .vtu."""
    reader = vtkXMLPUnstructuredGridReader() if file.suffix == ".pvtu" else vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()
