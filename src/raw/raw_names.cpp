#include "raw_names.hpp"

#include <sstream>

#include "knot_utm/numeric/number.hpp"
#include "knot_utm/raw/raw_text.hpp"

namespace knot_utm {
namespace {

// Found in exports, manuals and programs that read exports of Instron (Bluehill, WaveMatrix), ZwickRoell (testXpert),
// MTS (TestSuite, TestWorks), Shimadzu (Trapezium), Hegewald & Peschke, MTI, CellScale, Mecmesin and Tinius Olsen, and
// the words of the test standards in other languages.
constexpr const char* kTimeNames =
    "time;test time;total time;elapsed time;running time;machine time;"  // English
    "zeit;prüfzeit;pruefzeit;testzeit;versuchszeit;messzeit;laufzeit;"   // German
    "czas;czas próby;czas badania;godzina;"                              // Polish
    "temps;temps d'essai;durée;durée d'essai;"                           // French
    "tiempo;tiempo de ensayo;tiempo de prueba;"                          // Spanish
    "tempo;tempo di prova;tempo prova;tempo de ensaio;"                  // Italian, Portuguese
    "tijd;testtijd;proeftijd;"                                           // Dutch
    "čas;čas zkoušky;tid;zaman;süre;idő;"                                // Czech, Swedish, Turkish, Hungarian
    "время;время испытания;"                                             // Russian
    "时间;试验时间;测试时间;測試時間;試驗時間;"                          // Chinese
    "時間;試験時間;経過時間;測定時間";                                   // Japanese

// What may be the travel of the crosshead or of an extensometer on the specimen.
constexpr const char* kExtensionNames =
    "extension;tensile extension;tensile displacement;compressive extension;compressive displacement;"  // English
    "standard travel;deformation;ext;"
    "standardweg;verlängerung;verformung;"        // German
    "wydłużenie;droga standardowa;"               // Polish
    "course standard;allongement;"                // French
    "extensión;alargamiento;recorrido estándar;"  // Spanish
    "estensione;allungamento;corsa standard;"     // Italian
    "extensão;alongamento;curso padrão;"          // Portuguese
    "standaardweg;verlenging;"                    // Dutch
    "prodloužení;förlängning;uzama;удлинение;"    // Czech, Swedish, Turkish, Russian
    "伸长;伸长量;伸長;伸長量;标准行程;伸び";      // Chinese, Japanese

// The travel of the crosshead alone.
constexpr const char* kTravel =
    "displacement;crosshead displacement;crosshead extension;crosshead travel;crosshead;stroke;"  // English
    "travel;disp;disp.;axial displacement;displacement(linear|digital position);crosshead position;position;"
    "crosshead absolute;crosshead abs.;absolute crosshead travel;grip to grip separation;grip separation;"
    "machine displacement;actuator displacement;actuator position;axial disp;"
    "traversenweg;verfahrweg;maschinenweg;kolbenweg;weg;traverse;traverse abs.;traverse absolut;"  // German
    "traversenweg absolut;traversenposition;werkzeugabstand;einspannabstand;"
    "przemieszczenie;droga;droga trawersy;trawersa;"                                        // Polish
    "déplacement;déplacement de la traverse;déplacement traverse;course;traverse absolue;"  // French
    "course traverse;course traverse absolue;écartement entre outils;écartement entre mors;"
    "desplazamiento;desplazamiento del cabezal;desplazamiento de la cruceta;carrera;recorrido;"  // Spanish
    "travesaño;travesaño absoluto;separación de mordazas;"
    "spostamento;spostamento traversa;spostamento della traversa;corsa;corsa traversa;"  // Italian
    "traversa;traversa assoluta;"
    "deslocamento;deslocamento da travessa;curso;travessa;travessa absoluta;"  // Portuguese
    "verplaatsing;traverseweg;slag;traverse absoluut;"                         // Dutch
    "dráha;posuv;příčník;väg;rörelse;yer değiştirme;elmozdulás;"               // Czech, Swedish, Turkish, Hungarian
    "перемещение;перемещение траверсы;ход;"                                    // Russian
    "位移;横梁位移;行程;橫樑位移;"                                             // Chinese
    "変位;ストローク;クロスヘッド変位;クロスヘッド;変位量;移動量";             // Japanese

constexpr const char* kLoadNames =
    "load;force;standard force;test force;axial force;axial load;tensile force;tensile load;"  // English
    "load(linear|load);compressive load;compressive force;machine load;machine force;load cell;"
    "last;kraft;standardkraft;prüfkraft;pruefkraft;zugkraft;druckkraft;"    // German
    "obciążenie;siła;siła standardowa;"                                     // Polish
    "charge;force standard;force d'essai;effort;"                           // French
    "carga;fuerza;fuerza estándar;fuerza de ensayo;"                        // Spanish
    "carico;forza;forza standard;forza di prova;"                           // Italian
    "força;força padrão;força de ensaio;"                                   // Portuguese
    "kracht;standaardkracht;trekkracht;belasting;"                          // Dutch
    "síla;standardní síla;standardkraft;dragkraft;kuvvet;yük;erő;"          // Czech, Swedish, Turkish, Hungarian
    "нагрузка;сила;усилие;стандартная сила;"                                // Russian
    "力;力值;试验力;载荷;荷载;负荷;拉力;标准力;试验载荷;負荷;載荷;試驗力;"  // Chinese
    "試験力;荷重;引張荷重;引張力";                                          // Japanese

// Spellings of one unit stand behind its size in SI units.
constexpr const char* kTimeUnits =
    "1;s;sec;secs;second;seconds;sek;sekunde;sekunden;seconde;secondes;segundo;segundos;secondi;秒\n"
    "1e-3;ms;msec;msecs;millisecond;milliseconds\n1e-6;us;µs;microseconds\n"
    "60;min;mins;minute;minutes;minuten;minuto;minutos;minuti;分\n"
    "3600;h;hr;hrs;hour;hours;std;stunde;stunden;heure;heures;hora;horas";
constexpr const char* kLengthUnits =
    "1e-3;mm;millimeter;millimeters;millimetre;millimetres;毫米\n1;m;meter;meters;metre;metres\n"
    "1e-2;cm;centimeter;centimeters;centimetre;centimetres;厘米\n1e-1;dm\n"
    "1e-6;um;µm;micron;microns;micrometer;micrometers;微米\n"
    "0.0254;in;inch;inches;\";''\n0.3048;ft;foot;feet;'\n2.54e-5;mil;mils;thou";
constexpr const char* kForceUnits =
    "1;n;newton;newtons;牛;牛顿\n1e3;kn;kilonewton;kilonewtons;千牛\n10;dan;decanewton;dekanewton;decanewtons\n"
    "1e-3;mn;millinewton;millinewtons\n1e-2;cn;centinewton;centinewtons\n"
    "9.80665e-3;gf;g;gram;grams;gramme;grammes;gramm;p;pond\n"
    "9.80665;kgf;kg;kgs;kilogram;kilograms;kilogramm;kp;kilopond\n9806.65;tf;t;tonf\n"
    "4.4482216152605;lbf;lbsf;lb;lbs;pound;pounds;pound-force;pounds-force\n"
    "4448.2216152605;kip;kips;klbf;klb\n0.27801385095378125;ozf;oz;ounce;ounces";

std::vector<std::string> list(const std::string& names, char mark = ';') {
  std::istringstream text(names);
  std::vector<std::string> out;
  for (std::string name; std::getline(text, name, mark);) out.push_back(name);
  return out;
}

RawQuantity quantity(const char* name, double CurveRow::*value, const std::string& names, const std::string& machines,
                     const char* units, const char* allowed) {
  RawQuantity out{name, value, list(names), 0, allowed, {}, {}};
  out.machines = out.names.size();
  for (const std::string& own : list(machines)) out.names.push_back(own);
  for (std::size_t i = 0; i < out.names.size(); ++i) out.ranks.emplace(folded(out.names[i]), i);
  for (const std::string& line : list(units, '\n')) {
    const std::vector<std::string> spellings = list(line);
    for (std::size_t i = 1; i < spellings.size(); ++i)
      out.units.emplace(folded(spellings[i]), *parse_number(spellings[0]));
  }
  return out;
}

}  // namespace

const std::array<RawQuantity, 3>& raw_quantities() {
  static const std::array<RawQuantity, 3> all{
      {quantity("time", &CurveRow::time, kTimeNames, "", kTimeUnits, "ms, s, min or h"),
       quantity("extension", &CurveRow::extension, kExtensionNames, kTravel, kLengthUnits,
                "um, mm, cm, m, in, ft or mil"),
       quantity("load", &CurveRow::load, kLoadNames, "", kForceUnits,
                "mN, cN, N, daN, kN, gf (g), kgf (kg, kp), lbf (lb), ozf or kip")}};
  return all;
}

std::optional<double> si_of(const RawQuantity& quantity, const std::string& unit) {
  if (unit == "MN") return std::nullopt;  // mega is not milli
  const auto known = quantity.units.find(folded(unit));
  return known != quantity.units.end() ? std::optional<double>(known->second) : std::nullopt;
}

}  // namespace knot_utm
