"""Which characters the typefaces of this machine have. Fontconfig knows: `fc-list`, which Pango brings along."""
import functools
import html
import re
import subprocess

LATIN = 0x250  # below it every typeface has all letters that there are


@functools.lru_cache(maxsize=None)
def families_with(characters):
    """Families that have all of these characters; None: nobody knows."""
    asked = " ".join(f"{ord(one):x}" for one in characters)
    try:
        done = subprocess.run(["fc-list", f":charset={asked}", "family"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    names = sorted({line.split(",")[0] for line in done.stdout.splitlines() if line})
    return sorted(names, key=lambda name: ("Mono" in name, "Sans" not in name))


def special(text):
    """The characters that a typeface may lack, each once, in the order of their numbers."""
    return "".join(sorted({one for one in text if ord(one) >= LATIN and one.isprintable()}))


def without_typeface(page):
    """The characters of a page that no typeface has."""
    text = html.unescape(re.sub(r"<(style|script).*?</\1>|<[^>]*>", "", page, flags=re.DOTALL))
    characters = special(text)
    if not characters or families_with(characters) != []:
        return ""
    return "".join(one for one in characters if families_with(one) == [])


MOST = 12  # characters that are named


def told(characters):
    """The line that tells of them; empty: there are none."""
    if not characters:
        return ""
    names = ", ".join(f"{one} (U+{ord(one):04X})" for one in characters[:MOST])
    more = f" and {len(characters) - MOST} more" if len(characters) > MOST else ""
    return (f"No typeface of this machine has {names}{more}: the PDF and the figures cannot show them. Install one that has, for "
            "Chinese, Japanese and Korean Debian's package fonts-droid-fallback, and make this report again.")
