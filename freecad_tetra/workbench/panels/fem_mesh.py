class ToFemMesh:
    pass
