"""What the engine has made as objects of a Blender scene: instances, masses, materials, pictures."""
