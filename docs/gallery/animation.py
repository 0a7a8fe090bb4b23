"""
An animation, frame by frame
============================

A scene never changes: `scene.updated` makes another one, which shares whatever is the same. Turning
the camera or dimming a light takes a fraction of a millisecond, so an animation is a loop.
"""

import matplotlib.pyplot as plt
import numpy as np

import pymlt as mlt
from pymlt.lab import gallery

gallery.style()

scene = mlt.load_dict(mlt.scenes.glass_ball(), size=(96, 96))
parameters = scene.parameters()
print("\n".join(name for name in parameters if name.startswith(("sensor.", "light."))))

# %%
# From frame to frame the ball grows and the light becomes redder.

FRAMES = 8
radius = parameters["ball.radius"]
radiance = np.array(parameters["light.emitter.radiance"])

images = []
for t in np.linspace(0, 1, FRAMES):
    frame = scene.updated(
        {
            "ball.radius": radius * (0.5 + 0.5 * t),
            "light.emitter.radiance": radiance * [1, 1 - 0.5 * t, 1 - 0.8 * t],
        }
    )
    images.append(mlt.tonemap(mlt.render(frame, "bdpt", spp=8, seed=1)))

# %%

figure, axes = plt.subplots(2, FRAMES // 2, figsize=(11, 5.6))
for i, (ax, image) in enumerate(zip(axes.ravel(), images, strict=True)):
    ax.imshow(image)
    ax.set(title=f"frame {i}")
    ax.axis("off")
plt.show()
