# A compressor blade without its root: NACA 65-like profile, 8 % to 4 % thick, chord 60 to 45 mm, twisted by 35 degrees,
# 120 mm high; binary STL written by hand. mm.
import math, struct
n, m = 40, 30
def section(z):
    s = z / 120.0
    chord, thick, twist = 60 - 15 * s, 0.08 - 0.035 * s, math.radians(20 + 35 * s)
    points = []
    for k in range(2 * n):
        up = k < n
        t = math.pi * (k if up else 2 * n - k) / n
        x = 0.5 * (1 + math.cos(t))
        y = 5 * thick * (0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.0936 * x**4)
        y += 0.0015 * x
        camber = 0.24 * x * (1 - x)
        px, py = chord * (x - 0.4), chord * (camber + (y if up else -y))
        points.append((px * math.cos(twist) - py * math.sin(twist), px * math.sin(twist) + py * math.cos(twist), z))
    return points
rings = [section(120.0 * j / m) for j in range(m + 1)]
triangles = []
for j in range(m):
    for k in range(2 * n):
        a, b = rings[j][k], rings[j][(k + 1) % (2 * n)]
        c, d = rings[j + 1][(k + 1) % (2 * n)], rings[j + 1][k]
        triangles += [(a, b, c), (a, c, d)]
for ring, turn in ((rings[0], True), (rings[m], False)):
    for k in range(0, n):      # strips between upper and lower side
        u0, u1 = ring[k], ring[k + 1]
        l0, l1 = ring[(2 * n - k) % (2 * n)], ring[2 * n - k - 1]
        for t in ((u0, u1, l1), (u0, l1, l0)):
            if len(set(t)) == 3: triangles.append(t[::-1] if turn else t)
with open("blade.stl", "wb") as f:
    f.write(b"blade.py".ljust(80)); f.write(struct.pack("<I", len(triangles)))
    for t in triangles: f.write(struct.pack("<12fH", 0, 0, 0, *t[0], *t[1], *t[2], 0))
