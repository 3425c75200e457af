"""A Monte Carlo estimate of light on surfaces of glTF's metallic-roughness material: GGX with height-correlated Smith shadowing,
Fresnel by Schlick, a Lambertian base under it. Samples of the light and of the material are combined by the balance heuristic. What
single scattering loses is returned by scaling the reflection (Turquin, Practical multiple scattering compensation for microfacet
models, 2019). Needs numpy; shares no code with burnish, which gives positions and normals only."""
import numpy as np

rng = np.random.default_rng(1)


def dot(a, b):
    return (a * b).sum(-1)


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


class Environment:
    """An equirectangular image, sampled by its brightness."""
    def __init__(self, image, strength):
        self.image, (self.height, self.width) = image * strength, image.shape[:2]
        solid = np.sin((np.arange(self.height) + 0.5) / self.height * np.pi) * 2 * np.pi ** 2 / self.width / self.height
        weight = image.sum(-1) * solid[:, None] + 1e-12
        self.density = weight / weight.sum() / solid[:, None]
        self.cumulative = np.cumsum(weight.ravel() / weight.sum())

    def sample(self, u):
        i = np.searchsorted(self.cumulative, u).clip(0, self.cumulative.size - 1)
        theta = (i // self.width + rng.random(len(i))) / self.height * np.pi
        phi = ((i % self.width + rng.random(len(i))) / self.width - 0.5) * 2 * np.pi
        return np.stack((np.sin(theta) * np.cos(phi), np.cos(theta), np.sin(theta) * np.sin(phi)), -1)

    def look(self, w):
        x = ((np.arctan2(w[:, 2], w[:, 0]) / 2 / np.pi + 0.5) * self.width).astype(int) % self.width
        y = (np.arccos(w[:, 1].clip(-1, 1)) / np.pi * self.height).astype(int).clip(0, self.height - 1)
        return self.image[y, x], self.density[y, x]


def visible_normal(v, alpha, u):
    """A microfacet's normal that the viewer v sees, in the frame of the surface (Heitz, Sampling the GGX distribution of visible
    normals, 2018)."""
    stretched = unit(v * (alpha, alpha, 1))
    side = np.stack((-stretched[:, 1], stretched[:, 0], np.zeros(len(v))), -1)
    x = unit(np.where(dot(side, side)[:, None] > 1e-12, side, (1.0, 0, 0)))
    r, phi = np.sqrt(u), 2 * np.pi * rng.random(len(v))
    a, s = r * np.cos(phi), 0.5 * (1 + stretched[:, 2])
    b = (1 - s) * np.sqrt(np.maximum(0, 1 - a * a)) + s * r * np.sin(phi)
    normal = a[:, None] * x + b[:, None] * np.cross(stretched, x) + np.sqrt(np.maximum(0, 1 - a * a - b * b))[:, None] * stretched
    return unit(np.maximum(normal * (alpha, alpha, 1), (-np.inf, -np.inf, 1e-6)))


def smith(c, alpha):
    return (np.sqrt(1 + alpha * alpha * (1 / np.maximum(c * c, 1e-12) - 1)) - 1) / 2


def fresnel(f0, cosine):
    return f0 + (1 - f0) * (1 - cosine.clip(0, 1))[:, None] ** 5


def albedo(f0, alpha):
    """What single scattering reflects of uniform light, at 64 cosines."""
    cosines = (np.arange(64) + 0.5) / 64
    v = np.repeat(np.stack((np.sqrt(1 - cosines ** 2), 0 * cosines, cosines), -1), 2000, 0)
    h = visible_normal(v, alpha, rng.random(len(v)))
    l = 2 * dot(v, h)[:, None] * h - v
    share = np.where(l[:, 2] > 0, (1 + smith(v[:, 2], alpha)) / (1 + smith(v[:, 2], alpha) + smith(l[:, 2], alpha)), 0)
    return cosines, (fresnel(f0, dot(v, h)) * share[:, None]).reshape(64, 2000, -1).mean(1)


def radiance(points, normals, eye, light, base, metallic, roughness, samples):
    """What points send to eye. base: three linear channels."""
    alpha, f0 = max(roughness ** 2, 1e-3), 0.04 * (1 - metallic) + np.array(base) * metallic
    v = unit(eye - points)
    x = unit(np.cross(np.where(np.abs(normals[:, :1]) < 0.9, (1.0, 0, 0), (0, 1.0, 0)), normals))
    frame = np.stack((x, np.cross(normals, x), normals), 1)
    local = np.einsum("nij,nj->ni", frame, v)
    local = unit(np.maximum(local, (-np.inf, -np.inf, 1e-3)))
    cosines, white = albedo(np.ones(1), alpha)
    gain = 1 + f0 * (1 / np.interp(local[:, 2], cosines, white[:, 0]) - 1)[:, None]
    reflected = np.stack([np.interp(local[:, 2], cosines, channel) for channel in albedo(f0, alpha)[1].T], -1) * gain
    matt = np.array(base) * (1 - metallic) * (1 - reflected) / np.pi

    def scattered(w):
        """Radiance that comes by direction w, the density of the material's samples and of the light's."""
        l = np.einsum("nij,nj->ni", frame, w)
        h = unit(l + local)
        d = alpha ** 2 / np.pi / (h[:, 2] ** 2 * (alpha ** 2 - 1) + 1) ** 2
        a, b = smith(local[:, 2], alpha), smith(l[:, 2], alpha)
        mirror = (d / (1 + a + b) / 4 / local[:, 2])[:, None] * fresnel(f0, dot(local, h)) * gain
        seen, density = light.look(w)
        up = l[:, 2] > 1e-6
        value = np.where(up[:, None], (mirror + matt * l[:, 2:]) * seen, 0)
        own = np.where(up, 0.5 * d / (1 + a) / 4 / local[:, 2] + 0.5 * l[:, 2] / np.pi, 0)
        return value / np.maximum(own + density, 1e-12)[:, None]

    total = np.zeros((len(points), 3))
    for i in range(samples):
        total += scattered(light.sample((i + rng.random(len(points))) / samples))
        h = visible_normal(local, alpha, (i + rng.random(len(points))) / samples)
        l = 2 * dot(local, h)[:, None] * h - local
        z, phi = np.sqrt(rng.random(len(points))), 2 * np.pi * rng.random(len(points))
        r = np.sqrt(1 - z * z)
        l = np.where(rng.random((len(points), 1)) < 0.5, l, np.stack((r * np.cos(phi), r * np.sin(phi), z), -1))
        total += scattered(np.einsum("nij,ni->nj", frame, l))
    return total / samples
