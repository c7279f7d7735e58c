#include "knot_utm/run/build_identity.hpp"

#include <elf.h>
#include <link.h>
#include <sys/auxv.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace knot_utm {
namespace {

constexpr std::string_view kOwner("GNU\0", 4);

std::size_t rounded_up(std::size_t bytes, std::size_t to) { return (bytes + to - 1) / to * to; }

/// The build id among the notes of a segment, in hexadecimal digits; empty: it is not there.
std::string build_id_in(const char* notes, std::size_t size, std::size_t alignment) {
  for (std::size_t at = 0; at + sizeof(ElfW(Nhdr)) <= size;) {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes + at, sizeof(note));
    const std::size_t owner = at + sizeof(note);
    const std::size_t content = rounded_up(owner + note.n_namesz, alignment);
    if (content + note.n_descsz > size) return {};
    if (note.n_type == NT_GNU_BUILD_ID && std::string_view(notes + owner, note.n_namesz) == kOwner) {
      std::string id;
      for (std::size_t i = 0; i < note.n_descsz; ++i) {
        std::array<char, 3> digits{};
        std::snprintf(digits.data(), digits.size(), "%02x", static_cast<unsigned char>(notes[content + i]));
        id += digits.data();
      }
      return id;
    }
    at = rounded_up(content + note.n_descsz, alignment);
  }
  return {};
}

std::string build_id_of(const dl_phdr_info& loaded) {
  for (std::size_t i = 0; i < loaded.dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = loaded.dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const ElfW(Addr) address = loaded.dlpi_addr + segment.p_vaddr;
    const char* notes = nullptr;
    std::memcpy(&notes, &address, sizeof(notes));
    std::string id = build_id_in(notes, segment.p_memsz, segment.p_align == 8 ? 8 : 4);
    if (!id.empty()) return id;
  }
  return {};
}

struct Identity {
  std::string text;
  bool known = true;
};

int add(dl_phdr_info* loaded, std::size_t /*size*/, void* to) {
  // The kernel's own page, which computes nothing.
  if (loaded->dlpi_addr == getauxval(AT_SYSINFO_EHDR)) return 0;
  auto& identity = *static_cast<Identity*>(to);
  const std::string id = build_id_of(*loaded);
  identity.known &= !id.empty();
  identity.text += id + '\n';
  return 0;
}

/// Which of several ways to compute a function the library of mathematics takes; a folder may be shared by computers.
std::string processor() {
#ifdef __x86_64__
  return __builtin_cpu_supports("fma") != 0 && __builtin_cpu_supports("avx2") != 0 ? "fma\n" : "no fma\n";
#else
  return "";
#endif
}

std::string identity() {
  Identity all;
  dl_iterate_phdr(add, &all);
  return all.known ? all.text + processor() : "";
}

}  // namespace

const std::string& build_identity() {
  static const std::string text = identity();
  return text;
}

}  // namespace knot_utm
