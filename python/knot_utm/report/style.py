"""How every figure looks, and how it becomes a part of a page: the same bytes for the same run."""
import base64
import io
import logging
import re
import warnings

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: E402
from PIL import Image  # noqa: E402

INK, GREY, FAINT = "#22303c", "#5f6e7b", "#d9e0e6"
BLUE, ORANGE, GREEN, VIOLET, RED, GOLD = "#1f5f99", "#b95a15", "#2a7554", "#6d4a9c", "#a02020", "#806416"
PHASES = {"tie": "#f3e6c8", "release": "#e9efd2", "mount": "#d8eee3", "preload": "#d6e9ee", "balance": "#c9ced3",
          "pull": "#dfe6f3", "hold": "#ece0f1", "cycle": "#f4dfe3", "return": "#e6e6e6",
          "follow": "#dcecf2"}
ROLLER, HUB = "#e3e8ec", "#b3bfc9"
DEFINITIONS = re.compile(rb" *<defs>\n(.*?) *</defs>\n", re.DOTALL)
SMALL, USUAL = 8.5, 9.5  # letters [pt]; none is smaller than SMALL


class Look:
    """A figure for a page of a certain width. `width`: of the figure [in]; `left`, `right`: of its axes [in]."""

    def __init__(self, width, left, right):
        self.width, self.left, self.right = width, left, right
        self.is_narrow = width < 5.0

    def room(self, height, bottom, top, right=None):
        """The place of the axes in a figure of a height [in], as matplotlib takes it."""
        return {"left": self.left / self.width, "right": 1.0 - (self.right if right is None else right) / self.width,
                "bottom": bottom / height, "top": 1.0 - top / height}


WIDE = Look(8.0, 0.72, 0.12)    # a screen, and a sheet of A4
NARROW = Look(3.5, 0.62, 0.12)  # a telephone
LOOKS = (WIDE, NARROW)

# A typeface that is not there is replaced by the next one: no news.
logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)
warnings.filterwarnings("ignore", message="Glyph .* missing from")  # the page tells which
plt.rcParams.update({
    "svg.hashsalt": "knot_utm", "svg.fonttype": "path",
    "font.family": ["Liberation Sans", "Arial", "DejaVu Sans", "Droid Sans Fallback", "Noto Sans CJK SC"],  # for other letters
    "font.size": USUAL, "mathtext.fontset": "dejavusans",
    "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": GREY, "axes.linewidth": 0.7,
    "xtick.color": GREY, "ytick.color": GREY, "xtick.labelcolor": INK, "ytick.labelcolor": INK,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": FAINT,
    "grid.linewidth": 0.6, "axes.axisbelow": True, "legend.frameon": False, "legend.fontsize": SMALL,
    "axes.labelsize": USUAL, "xtick.labelsize": SMALL, "ytick.labelsize": SMALL, "axes.titlesize": USUAL})


def stacked(look, heights):
    """Axes of these heights [in], one below the other over the same extensions; and how tall the figure is [in]."""
    tall = sum(heights) + 0.9
    figure, axes = plt.subplots(len(heights), 1, figsize=(look.width, tall), sharex=True, squeeze=False,
                                gridspec_kw={"height_ratios": heights, "hspace": 0.12})
    return figure, list(axes[:, 0]), tall


def as_svg(figure):
    """A data: URI."""
    return embedded("image/svg+xml", definitions_first(saved(figure, format="svg", metadata={"Date": None, "Creator": None})))


def as_png(figure, dpi):
    """A data: URI, without transparency, which is quicker to pack."""
    figure.set_dpi(dpi)
    canvas, out = FigureCanvasAgg(figure), io.BytesIO()
    canvas.draw()
    Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB").save(out, "PNG", dpi=(dpi, dpi), compress_level=4)
    plt.close(figure)
    return embedded("image/png", out.getvalue())


def saved(figure, **how):
    out = io.BytesIO()
    figure.savefig(out, **how)
    plt.close(figure)
    return out.getvalue()


def definitions_first(svg):
    """The same drawing with all that it uses again, such as its letters, in front: WeasyPrint looks for each of them from the
    beginning, and would take as long for that as for all the rest."""
    head, begin, drawing = svg.partition(b'<g id="figure_1">')
    return head + b"<defs>\n" + b"".join(DEFINITIONS.findall(drawing)) + b"</defs>\n" + begin + DEFINITIONS.sub(b"", drawing)


def short(file, letters):
    """The last two parts of a path, the last letters of a long name."""
    text = "/".join(file.split("/")[-2:])
    text = text if len(text) <= letters else "…" + text[1 - letters:]
    return text.replace("$", r"\$")  # which begins a formula


def embedded(kind, content):
    """Bytes as a data: URI, so that a page needs no other file."""
    return f"data:{kind};base64," + base64.b64encode(content).decode("ascii")
