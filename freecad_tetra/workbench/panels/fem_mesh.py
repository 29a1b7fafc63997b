class ToFemMesh: pass
