#include "raw_names.hpp"

#include <sstream>

namespace knot_utm {
namespace {

// Found in exports, manuals and programs that read exports of Instron (Bluehill, WaveMatrix), ZwickRoell (testXpert),
// MTS (TestSuite, TestWorks), Shimadzu (Trapezium), Hegewald & Peschke, Mecmesin and Tinius Olsen, and the words of the
// test standards in other languages. The crosshead's own travel stands before what else is measured of the specimen.
constexpr const char* kTime =
    "time;test time;total time;elapsed time;running time;"     // English
    "zeit;prüfzeit;pruefzeit;testzeit;versuchszeit;messzeit;"  // German
    "czas;czas próby;czas badania;godzina;"                    // Polish
    "temps;temps d'essai;durée;"                               // French
    "tiempo;tiempo de ensayo;tiempo de prueba;"                // Spanish
    "tempo;tempo di prova;tempo prova;tempo de ensaio;"        // Italian, Portuguese
    "tijd;testtijd;proeftijd;"                                 // Dutch
    "时间;试验时间;测试时间;測試時間;試驗時間;"                // Chinese
    "時間;試験時間;経過時間;測定時間";                         // Japanese

constexpr const char* kExtension =
    "extension;displacement;crosshead displacement;crosshead extension;crosshead travel;crosshead;stroke;"  // English
    "standard travel;travel;disp;disp.;axial displacement;tensile extension;tensile displacement;"
    "displacement(linear|digital position);crosshead position;position;"
    "traversenweg;standardweg;verfahrweg;maschinenweg;kolbenweg;weg;verlängerung;traverse;traverse abs.;"  // German
    "traverse absolut;traversenposition;"
    "przemieszczenie;droga;droga trawersy;wydłużenie;"                                           // Polish
    "déplacement;déplacement de la traverse;déplacement traverse;course;allongement;"            // French
    "desplazamiento;desplazamiento del cabezal;desplazamiento de la cruceta;carrera;recorrido;"  // Spanish
    "extensión;alargamiento;"
    "spostamento;spostamento traversa;spostamento della traversa;corsa;corsa traversa;"  // Italian
    "estensione;allungamento;"
    "deslocamento;deslocamento da travessa;curso;extensão;alongamento;"  // Portuguese
    "verplaatsing;traverseweg;slag;verlenging;"                          // Dutch
    "位移;横梁位移;行程;伸长;伸长量;橫樑位移;伸長;伸長量;"               // Chinese
    "変位;ストローク;クロスヘッド変位;クロスヘッド;変位量;移動量;伸び";  // Japanese

constexpr const char* kLoad =
    "load;force;standard force;test force;axial force;axial load;tensile force;tensile load;"  // English
    "load(linear|load);"
    "last;kraft;standardkraft;prüfkraft;pruefkraft;zugkraft;"               // German
    "obciążenie;siła;siła standardowa;"                                     // Polish
    "charge;force standard;force d'essai;effort;"                           // French
    "carga;fuerza;fuerza estándar;fuerza de ensayo;"                        // Spanish
    "carico;forza;forza standard;forza di prova;"                           // Italian
    "força;força padrão;força de ensaio;"                                   // Portuguese
    "kracht;standaardkracht;trekkracht;belasting;"                          // Dutch
    "力;力值;试验力;载荷;荷载;负荷;拉力;标准力;试验载荷;負荷;載荷;試驗力;"  // Chinese
    "試験力;荷重;引張荷重;引張力";                                          // Japanese

std::vector<std::string> list(const char* names) {
  std::istringstream text(names);
  std::vector<std::string> out;
  for (std::string name; std::getline(text, name, ';');) out.push_back(name);
  return out;
}

}  // namespace

const std::array<RawQuantity, 3>& raw_quantities() {
  static const std::array<RawQuantity, 3> all{{{"time",
                                                &CurveRow::time,
                                                list(kTime),
                                                {{"s", 1.0},
                                                 {"sec", 1.0},
                                                 {"ms", 1e-3},
                                                 {"msec", 1e-3},
                                                 {"min", 60.0},
                                                 {"h", 3600.0},
                                                 {"秒", 1.0},
                                                 {"分", 60.0}},
                                                "ms, s, sec, min or h"},
                                               {"extension",
                                                &CurveRow::extension,
                                                list(kExtension),
                                                {{"mm", 1e-3},
                                                 {"m", 1.0},
                                                 {"cm", 1e-2},
                                                 {"um", 1e-6},
                                                 {"µm", 1e-6},
                                                 {"μm", 1e-6},
                                                 {"in", 0.0254},
                                                 {"inch", 0.0254},
                                                 {"ft", 0.3048},
                                                 {"毫米", 1e-3},
                                                 {"厘米", 1e-2},
                                                 {"微米", 1e-6}},
                                                "um, mm, cm, m, in or ft"},
                                               {"load",
                                                &CurveRow::load,
                                                list(kLoad),
                                                {{"n", 1.0},
                                                 {"kn", 1e3},
                                                 {"mn", 1e-3},
                                                 {"cn", 1e-2},
                                                 {"gf", 9.80665e-3},
                                                 {"kgf", 9.80665},
                                                 {"lbf", 4.4482216152605},
                                                 {"牛", 1.0},
                                                 {"牛顿", 1.0},
                                                 {"千牛", 1e3}},
                                                "mN, cN, N, kN, gf, kgf or lbf"}}};
  return all;
}

}  // namespace knot_utm
