"""What goes into the page of a fit."""
from knot_utm.report.fit import Fit
from knot_utm.report.fit_figures import curve, profiles
from knot_utm.report.page import files_of, render
from knot_utm.report.quantities import number
from knot_utm.report.run import printable
from knot_utm.report.style import LOOKS


def report_on_fit(folder, command, version):
    fit = Fit(folder)
    return render("fit.html.j2", {
        "title": "Fit of " + ("/".join(fit.curves[0].name.split("/")[-2:]) if fit.curves else "a curve"),
        "records": [(one.name, [curve(one, look) for look in LOOKS] if len(one.extension) else None) for one in fit.curves],
        "profiles": [profiles(fit.keys, look) for look in LOOKS] if fit.keys else None,
        "rows": [(key.name, told(key.value), end(key, "low"), end(key, "high"), "yes" if key.is_identifiable else "no")
                 for key in fit.keys],
        "correlation": [(one.name, other.name, told(fit.correlation.get(one.name, {}).get(other.name)))
                        for i, one in enumerate(fit.keys) for other in fit.keys[i + 1:]],
        "rms": told(fit.facts.get("rms")), "fits": fit.facts.get("fits"), "chi_square": told(fit.facts.get("chi_square")),
        "degrees": fit.facts.get("degrees_of_freedom"), "notes": fit.notes, "files": files_of(folder), "command": printable(command),
        "version": version, "folder": printable(folder)})


def end(key, side):
    return told(getattr(key, side)) + (" (not confirmed)" if side in key.unconfirmed else "")


def told(value):
    return "open" if value is None else number(value)
