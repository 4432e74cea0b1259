"""Section shapes from formulas. Every curve runs from its trailing edge over the upper side to the
leading edge and back along the lower side; lengths are in chords of the whole section."""
import numpy as np

SAMPLES = 20001


def thickness(x, t):
    """Half thickness of the NACA 4-digit series, closed (sharp) trailing edge.

    Abbott & von Doenhoff, Theory of Wing Sections, section 6.4, with the last coefficient 0.1036
    instead of 0.1015 so that the thickness is zero at x = 1.
    """
    a = (0.2969, -0.1260, -0.3516, 0.2843, -0.1036)
    return 5 * t * (a[0] * np.sqrt(x) + x * (a[1] + x * (a[2] + x * (a[3] + x * a[4]))))


def cosine(n=SAMPLES):
    """Parameters 0..1, clustered at both ends."""
    return (1 - np.cos(np.linspace(0, np.pi, n))) / 2


def smooth_step(s):
    """C2 step: 0 below s = 0, 1 above s = 1."""
    s = np.clip(s, 0, 1)
    return s**3 * (10 + s * (6 * s - 15))


def place(points, scale, degrees, origin):
    """Scale, turn counter-clockwise about the leading edge, and move the leading edge to origin."""
    a = np.radians(degrees)
    turn = np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])
    return scale * points @ turn + np.asarray(origin)


def closed(upper, lower):
    """Two curves from leading to trailing edge -> (upper from the trailing edge, lower to it)."""
    return upper[::-1], lower


def naca0012():
    x = cosine()
    y = thickness(x, 0.12)
    return closed(np.stack([x, y], 1), np.stack([x, -y], 1))


def arc_section(t, camber):
    """4-digit thickness t on the parabolic mean line y = 4 camber x (1 - x), added along y."""
    x = cosine()
    mean = 4 * camber * x * (1 - x)
    y = thickness(x, t)
    return np.stack([x, mean + y], 1), np.stack([x, mean - y], 1)


def main_section(t=0.15, camber=0.03, cove=(0.68, 0.80), blade=0.014):
    """A cambered 4-digit section with a cove: beyond the cove's start the lower side turns, by a C2
    step, into a blade under the upper side, of thickness 2 blade (1 - x) / (1 - cove end), and so
    is sharp at the trailing edge."""
    upper, lower = arc_section(t, camber)
    x = upper[:, 0]
    under_blade = upper[:, 1] - 2 * blade * (1 - x) / (1 - cove[1])
    s = smooth_step((x - cove[0]) / (cove[1] - cove[0]))
    y = (1 - s) * lower[:, 1] + s * np.maximum(under_blade, lower[:, 1])
    return upper, np.stack([x, y], 1)


def three_element():
    """Slat, main element with cove, and flap, in the chord of the stowed section (about 0..1)."""
    parts = {
        "slat": (arc_section(0.13, 0.14), 0.165, 37.5, (-0.0440, -0.0420)),
        "main": (main_section(), 0.80, 0.0, (0.06, 0.0)),
        "flap": (arc_section(0.14, 0.03), 0.28, -24.0, (0.8300, -0.0280)),
    }
    return {name: closed(*(place(side, scale, degrees, origin) for side in sides))
            for name, (sides, scale, degrees, origin) in parts.items()}
