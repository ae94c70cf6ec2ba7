"""Mesh files, one module for each format.

``read`` chooses by the extension; every format makes a ``mesh_file.MeshFile``.  OBJ and OFF go
through ``libigl`` after ``text`` has counted their lines, PLY and STL are read here, others by
``open3d``.
"""
