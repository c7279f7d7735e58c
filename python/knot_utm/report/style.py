"""How every figure looks, and how it becomes a part of a page: the same bytes for the same run."""
import base64
import io
import logging
import warnings

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

INK, GREY, FAINT = "#22303c", "#5f6e7b", "#d9e0e6"
BLUE, ORANGE, GREEN, VIOLET, RED, GOLD = "#1f5f99", "#b95a15", "#2a7554", "#6d4a9c", "#a02020", "#806416"
PHASES = {"tie": "#f3e6c8", "release": "#e9efd2", "mount": "#d8eee3", "preload": "#d6e9ee", "balance": "#c9ced3",
          "pull": "#dfe6f3", "hold": "#ece0f1", "cycle": "#f4dfe3", "return": "#e6e6e6", "follow": "#dcecf2"}
ROLLER, HUB = "#e3e8ec", "#b3bfc9"
SMALL, USUAL = 8.5, 9.5  # letters [pt]; none is smaller than SMALL
WIDTH, LEFT, RIGHT = 8.0, 0.72, 0.12  # of a figure, and beside its axes [in]
DPI = 150

logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)  # a typeface that is not there is replaced by the next one
warnings.filterwarnings("ignore", message="Glyph .* missing from")
matplotlib.rcParams.update({
    "font.family": ["Liberation Sans", "Arial", "DejaVu Sans", "Droid Sans Fallback", "Noto Sans CJK SC"],  # for other letters
    "font.size": USUAL, "mathtext.fontset": "dejavusans",
    "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": GREY, "axes.linewidth": 0.7,
    "xtick.color": GREY, "ytick.color": GREY, "xtick.labelcolor": INK, "ytick.labelcolor": INK,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": FAINT,
    "grid.linewidth": 0.6, "axes.axisbelow": True, "legend.frameon": False, "legend.fontsize": SMALL,
    "axes.labelsize": USUAL, "xtick.labelsize": SMALL, "ytick.labelsize": SMALL, "axes.titlesize": USUAL})


def new_figure(width, height):
    figure = Figure(figsize=(width, height))
    FigureCanvasAgg(figure)
    return figure


def stacked(heights, above=0.3, right=RIGHT):
    """A figure with axes of these heights [in], one below the other over the same x. `above`: what is left free there [in]."""
    tall = sum(heights) + 0.12 * len(heights) + 0.5 + above
    figure = new_figure(WIDTH, tall)
    axes = figure.subplots(len(heights), 1, sharex=True, squeeze=False, gridspec_kw={"height_ratios": heights, "hspace": 0.12})[:, 0]
    figure.subplots_adjust(left=LEFT / WIDTH, right=1.0 - right / WIDTH, bottom=0.5 / tall, top=1.0 - above / tall)
    return figure, list(axes)


def image_of(figure):
    """Its pixels, without transparency, which is quicker to pack."""
    figure.set_dpi(DPI)
    figure.canvas.draw()
    return Image.frombuffer("RGBA", figure.canvas.get_width_height(), figure.canvas.buffer_rgba()).convert("RGB")


def embedded(figure, kind="PNG"):
    """The figure as a data: URI, so that a page needs no other file. JPEG, which is quicker to pack, is for pictures without lines and
    small letters."""
    out, how = io.BytesIO(), {"quality": 92, "subsampling": 0} if kind == "JPEG" else {"compress_level": 3}
    image_of(figure).save(out, kind, dpi=(DPI, DPI), **how)
    return f"data:image/{kind.lower()};base64," + base64.b64encode(out.getvalue()).decode("ascii")


def short(file, letters=60):
    """The last two parts of a path, the last letters of a long name."""
    text = "/".join(file.split("/")[-2:])
    text = text if len(text) <= letters else "…" + text[1 - letters:]
    return text.replace("$", r"\$")  # which begins a formula
