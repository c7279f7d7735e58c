"""The names of columns and units in exports of testing machines, by quantity. This is data: a new name is a new word in a list.

Found in exports, manuals and programs that read exports of Instron (Bluehill, WaveMatrix), ZwickRoell (testXpert), MTS (793, TestSuite,
TestWorks), Shimadzu (Trapezium), Hegewald & Peschke, MTI, CellScale, Mecmesin and Tinius Olsen, and the words of the test standards
in other languages. Words are compared without capitals and accents (text.folded). Of several names in one file the first of the list
counts."""
import math
import re

from knot_utm.importing.text import folded

TIME = """
    time;test time;total time;elapsed time;running time;machine time;time measurement;x value
    zeit;prüfzeit;pruefzeit;testzeit;versuchszeit;messzeit;laufzeit;czas;czas próby;czas badania;godzina
    temps;temps d'essai;durée;durée d'essai;tiempo;tiempo de ensayo;tiempo de prueba
    tempo;tempo di prova;tempo prova;tempo de ensaio;tijd;testtijd;proeftijd;čas;čas zkoušky;tid;zaman;süre;idő
    время;время испытания;时间;试验时间;测试时间;測試時間;試驗時間;時間;試験時間;経過時間;測定時間"""

# What may be the travel of the crosshead or of an extensometer on the specimen.
EXTENSION = """
    extension;tensile extension;tensile displacement;compressive extension;compressive displacement;standard travel;deformation;ext
    standardweg;verlängerung;verformung;wydłużenie;droga standardowa;course standard;allongement
    extensión;alargamiento;recorrido estándar;estensione;allungamento;corsa standard;extensão;alongamento;curso padrão
    standaardweg;verlenging;prodloužení;förlängning;uzama;удлинение;伸长;伸长量;伸長;伸長量;标准行程;伸び"""

# The travel of the crosshead alone.
TRAVEL = """
    displacement;crosshead displacement;crosshead extension;crosshead travel;crosshead;stroke;travel;disp;disp.;axial displacement
    distance;crosshead position;position;crosshead absolute;crosshead abs.;absolute crosshead travel
    grip to grip separation;grip separation;machine displacement;actuator displacement;actuator position;axial disp
    traversenweg;verfahrweg;maschinenweg;kolbenweg;weg;traverse;traverse abs.;traverse absolut;traversenweg absolut
    traversenposition;werkzeugabstand;einspannabstand;przemieszczenie;droga;droga trawersy;trawersa
    déplacement;déplacement de la traverse;déplacement traverse;course;traverse absolue;course traverse;course traverse absolue
    écartement entre outils;écartement entre mors
    desplazamiento;desplazamiento del cabezal;desplazamiento de la cruceta;carrera;recorrido;travesaño;travesaño absoluto
    separación de mordazas
    spostamento;spostamento traversa;spostamento della traversa;corsa;corsa traversa;traversa;traversa assoluta
    deslocamento;deslocamento da travessa;curso;travessa;travessa absoluta;verplaatsing;traverseweg;slag;traverse absoluut
    dráha;posuv;příčník;väg;rörelse;yer değiştirme;elmozdulás;перемещение;перемещение траверсы;ход;位移;横梁位移;行程;橫樑位移
    変位;ストローク;クロスヘッド変位;クロスヘッド;変位量;移動量"""

LOAD = """
    load;force;standard force;test force;axial force;axial load;tensile force;tensile load
    primary load measurement;compressive load;compressive force;machine load;machine force;load cell
    last;kraft;standardkraft;prüfkraft;pruefkraft;zugkraft;druckkraft;obciążenie;siła;siła standardowa
    charge;force standard;force d'essai;effort;carga;fuerza;fuerza estándar;fuerza de ensayo
    carico;forza;forza standard;forza di prova;força;força padrão;força de ensaio;kracht;standaardkracht;trekkracht;belasting
    síla;standardní síla;standardkraft;dragkraft;kuvvet;yük;erő;нагрузка;сила;усилие;стандартная сила
    力;力值;试验力;载荷;荷载;负荷;拉力;标准力;试验载荷;負荷;載荷;試驗力;試験力;荷重;引張荷重;引張力"""

# The size of a unit in SI units, and its spellings.
TIME_UNITS = {
    1.0: "s;sec;secs;second;seconds;sek;sekunde;sekunden;seconde;secondes;segundo;segundos;secondi;秒",
    1e-3: "ms;msec;msecs;millisecond;milliseconds", 1e-6: "us;µs;microseconds",
    60.0: "min;mins;minute;minutes;minuten;minuto;minutos;minuti;分",
    3600.0: "h;hr;hrs;hour;hours;std;stunde;stunden;heure;heures;hora;horas"}
LENGTH_UNITS = {
    1e-3: "mm;millimeter;millimeters;millimetre;millimetres;毫米", 1.0: "m;meter;meters;metre;metres",
    1e-2: "cm;centimeter;centimeters;centimetre;centimetres;厘米", 1e-1: "dm",
    1e-6: "um;µm;micron;microns;micrometer;micrometers;微米",
    0.0254: "in;inch;inches;\";''", 0.3048: "ft;foot;feet;'", 2.54e-5: "mil;mils;thou"}
FORCE_UNITS = {
    1.0: "n;newton;newtons;牛;牛顿", 1e3: "kn;kilonewton;kilonewtons;千牛", 10.0: "dan;decanewton;dekanewton;decanewtons",
    1e-3: "mn;millinewton;millinewtons", 1e-2: "cn;centinewton;centinewtons",
    9.80665e-3: "gf;g;gram;grams;gramme;grammes;gramm;p;pond",
    9.80665: "kgf;kg;kgs;kilogram;kilograms;kilogramm;kp;kilopond", 9806.65: "tf;t", 8896.443230521: "ustonf", math.nan: "tonf;ton;tons",
    4.4482216152605: "lbf;lbsf;lb;lbs;pound;pounds;pound-force;pounds-force", 4448.2216152605: "kip;kips;klbf;klb",
    0.27801385095378125: "ozf;oz;ounce;ounces"}

# What a machine was told to do, as a part of a column's name: no reading.
SET_POINT = re.compile("command|set[ -]?point|target|demand|soll|consign|feedforward|error")
TONF = "8896.44 N (2000 lbf) in one program and 9806.65 N (1000 kgf) in another: give --units load=ustonf or load=tf"


class Quantity:
    """What a column may hold. `allowed`: its units, for messages."""

    def __init__(self, name, names, units, allowed, travel=""):
        self.name, self.allowed = name, allowed
        self.names = _words(names) + _words(travel)
        self.machines = len(_words(names))  # from this name on they say that it is the machine's own travel
        self.ranks = {folded(word): rank for rank, word in reversed([*enumerate(self.names)])}
        self.units = {folded(word): size for size, words in units.items() for word in _words(words)}

    def si(self, unit):
        """One such unit in SI units; None of one that is not known, NaN of one that has two sizes. Capitals mean nothing, but for MN, which
        is not mN."""
        return None if unit == "MN" else self.units.get(folded(unit))


def _words(text):
    return [word for line in text.strip().splitlines() for word in line.strip().split(";")] if text else []


QUANTITIES = (Quantity("time", TIME, TIME_UNITS, "ms, s, min or h"),
              Quantity("extension", EXTENSION, LENGTH_UNITS, "um, mm, cm, m, in, ft or mil", TRAVEL),
              Quantity("load", LOAD, FORCE_UNITS, "mN, cN, N, daN, kN, gf (g), kgf (kg, kp), lbf (lb), ozf or kip"))
