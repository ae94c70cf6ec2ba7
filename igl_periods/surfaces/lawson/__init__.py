"""Lawson's minimal surfaces ξ_{m,k} in the 3-sphere.

A minimal disc in a quadrilateral of great circles (``plateau``, ``disc``), reflected about its
sides until it closes up (``surface``); meshes without symmetry of the same surface
(``unstructured``); the exact period matrix, from the cyclic cover of the sphere that the surface is
(``periods``).

References
----------
Lawson, "Complete minimal surfaces in S³" (1970).
"""
