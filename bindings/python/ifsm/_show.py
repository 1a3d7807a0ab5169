"""What notebooks show of a model: a table and its outline, without any plotting library; and a picture with one. Of a
system a small picture, without any."""
import html as _html
import io
import struct
import zlib

import numpy as np

_SIZE = 240  # pixels of the outline's longer side
_SYSTEM_SIZE = 320  # pixels of a system's picture
_MOST_POINTS = 2000  # as many as such an outline can show


def html(model):
    rows = [("samples", model.sample_count), ("dimension", model.dimension), ("closed", "yes" if model.closed else "no"),
            ("control points", len(model.control_points)), ("levels", model.levels),
            ("details", f"{model.details_kept} of {model.detail_count}"), ("filter", repr(model.filter).strip("<>"))]
    table = "".join(f"<tr><th style='text-align:left'>{name}</th><td style='text-align:left'>"
                    f"{_html.escape(str(value))}</td></tr>" for name, value in rows)
    picture = _outline(model)
    return ("<div style='display:flex;gap:2em;align-items:center'>"
            f"<table><caption style='text-align:left'><b>ifsm.Model</b></caption>{table}</table>{picture}</div>")


def _outline(model):
    places = model.points()
    if model.dimension == 1:
        places = np.column_stack([np.linspace(0, 1, len(places)) * (np.ptp(places) or 1) * 3, places])
    places = places[:: max(1, len(places) // _MOST_POINTS), :2]
    low, high = places.min(axis=0), places.max(axis=0)
    scale = _SIZE / max(float((high - low).max()), np.finfo(float).tiny)
    width, height = (high - low) * scale
    at = (places - low) * scale
    line = " ".join(f"{x:.1f},{height - y:.1f}" for x, y in at)
    return (f"<svg width='{width + 4:.0f}' height='{height + 4:.0f}' viewBox='-2 -2 {width + 4:.1f} {height + 4:.1f}'>"
            f"<polyline points='{line}' fill='none' stroke='currentColor' stroke-width='1'/></svg>")


def png(model):
    """None without matplotlib, and of four dimensions."""
    if model.dimension > 3:
        return None
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        return None
    from . import plot

    figure = Figure(figsize=(6, 4), layout="constrained")
    FigureCanvasAgg(figure)
    plot.curve(model, ax=figure.subplots())
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=100)
    return data.getvalue()


def png_of_system(system):
    """None of systems that have no attractor."""
    if not system.contractive:
        return None
    colour = "tone" if system.dimension == 2 else "symbol"
    return encoded(system.render(_SYSTEM_SIZE, colour=colour, background="white", azimuth=0.6, elevation=0.4))


def encoded(pixels):
    """An array of shape (height, width, 4) as a PNG file's bytes."""
    height, width, _ = pixels.shape
    rows = np.zeros((height, 1 + 4 * width), np.uint8)  # each begins with the number of its filter, 0: none
    rows[:, 1:] = pixels.reshape(height, -1)
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)  # 8 bits a channel, RGBA
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(rows.tobytes())), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks)
