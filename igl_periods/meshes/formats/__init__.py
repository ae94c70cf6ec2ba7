"""Mesh files, one module for each format.

``read`` chooses by the extension; ``compression`` fetches the bytes; every format makes a
``mesh_file.MeshFile`` of them.  ``text`` knows lines and numbers of text formats, ``placement`` the
affine maps of scenes (glTF, 3MF).
"""
