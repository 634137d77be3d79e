"""What reports call the scenes of the convergence report."""

SCENES = {
    "cornell-empty": "Cornell box, empty",
    "cornell": "Cornell box (figure 15)",
    "lamps": "lamps on grey stone (figure 12)",
    "three-spheres": "three spheres (figure 13)",
    "depth-of-field": "depth of field (figure 18)",
    "still-spheres": "the bouncing spheres, still (figure 1)",
    "smoke": "smoke in the Cornell box (figure 16)",
    "mesh": "a mesh of 69312 triangles in the Cornell box",
    "glass-mesh": "the same mesh of glass",
    "many-lights": "200 small lights in the Cornell box",
    "rough-copper": "rough copper under a sky with its sun in the map",
    "rough-glass": "ground glass in the Cornell box",
    "still-life": "a glTF still life: normal maps, alpha, rough metal",
    "window": "sun and sky through a window",
}
