# All options as they are at first.
import bpy

bpy.context.scene.fairmesh.reset()
