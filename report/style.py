"""How every figure looks, and how it becomes a part of the page: the same bytes for the same run."""
import base64
import io
import logging

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

INK, GREY, FAINT = "#22303c", "#6b7a88", "#d9e0e6"
BLUE, ORANGE, GREEN, VIOLET = "#1f5f99", "#c8641b", "#2f7d5b", "#6d4a9c"
PHASES = {"tie": "#f3e6c8", "release": "#e9efd2", "mount": "#d8eee3", "preload": "#d6e9ee", "balance": "#c9ced3",
          "pull": "#dfe6f3", "hold": "#ece0f1", "cycle": "#f4dfe3", "return": "#e6e6e6",
          "follow": "#dcecf2"}
WIDTH = 9.6  # [in]

# A typeface that is not there is replaced by the next one: no news.
logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)
plt.rcParams.update({
    "svg.hashsalt": "knot_utm", "svg.fonttype": "path",
    "font.family": ["Liberation Sans", "Arial", "DejaVu Sans"], "font.size": 9.5, "mathtext.fontset": "dejavusans",
    "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": GREY, "axes.linewidth": 0.7,
    "xtick.color": GREY, "ytick.color": GREY, "xtick.labelcolor": INK, "ytick.labelcolor": INK,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": FAINT,
    "grid.linewidth": 0.6, "axes.axisbelow": True, "legend.frameon": False, "legend.fontsize": 8.5,
    "axes.labelsize": 9.5, "xtick.labelsize": 8.5, "ytick.labelsize": 8.5})


def as_svg(figure):
    """A data: URI."""
    return data_uri(figure, "image/svg+xml", format="svg", metadata={"Date": None, "Creator": None})


def as_png(figure, dpi):
    return data_uri(figure, "image/png", format="png", dpi=dpi, metadata={"Software": None})


def data_uri(figure, kind, **how):
    out = io.BytesIO()
    figure.savefig(out, **how)
    plt.close(figure)
    return f"data:{kind};base64," + base64.b64encode(out.getvalue()).decode("ascii")
