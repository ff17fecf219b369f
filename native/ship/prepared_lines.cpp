#include "prepared_lines.hpp"

#include "../folder.hpp"
#include "../numbers/crc32.hpp"
#include "../numbers/elementary.hpp"

namespace shipcollision {
namespace {

constexpr char CHECKSUM[] = "crc32 ";
constexpr size_t LAST_LINE = sizeof CHECKSUM - 1 + 8 + 1;  // eight digits and the end of the line
constexpr long long MOST_PARTS = 10000;
constexpr size_t LONGEST_FILE = size_t{64} << 20;  // bytes; a hull of ten thousand vertices has one million
constexpr size_t LONGEST_PATH = 4400;              // bytes; no system opens a path of more than 4096

bool starts_with(const char* text, const char* begin) { return strncmp(text, begin, strlen(begin)) == 0; }

bool ends_with_slash(const char* folder) { return folder[0] != '\0' && folder[strlen(folder) - 1] == '/'; }

bool check_first_line(const PreparedKind& kind, const char* content, size_t size, const char* file, Text& why) {
  const size_t length = strlen(kind.format);
  if (size < length || !starts_with(content, kind.format)) {
    why << file << " is no " << kind.name << ": write one with `shipcollision prepare " << kind.argument << "`";
    return false;
  }
  const char* version = content + length;
  size_t digits = 0;
  while (version[digits] >= '0' && version[digits] <= '9' && digits < 6) ++digits;
  const bool is_read = digits == strlen(kind.version) && starts_with(version, kind.version);
  if (version[digits] == '\n' && digits > 0 && !is_read) {
    why << file << " is a " << kind.name << " of version ";
    for (size_t i = 0; i < digits; ++i) {
      const char digit[2] = {version[i], '\0'};
      why << digit;
    }
    why << ", this FMU reads version " << kind.version << ": " << kind.what
        << " with the shipcollision that built the FMU, or build the FMU again";
    return false;
  }
  return true;
}

void put_checksum(Text& text, uint32_t checksum) {
  for (int shift = 28; shift >= 0; shift -= 4) {
    const char digit[2] = {"0123456789abcdef"[checksum >> shift & 15], '\0'};
    text << digit;
  }
}

bool check_checksum(const PreparedKind& kind, const char* content, size_t size, const char* file, uint32_t& checksum,
                    Text& why) {
  if (has_other_line_ends(content)) {
    why << file << " is damaged: its line ends were changed, as git and editors of Windows do; copy it as a binary "
        << "file, or " << kind.what << " again with `shipcollision prepare " << kind.argument << "`";
    return false;
  }
  const bool is_long_enough = size > LAST_LINE && content[size - LAST_LINE - 1] == '\n';
  const char* last = is_long_enough ? content + size - LAST_LINE : content;
  if (!is_long_enough || !starts_with(last, CHECKSUM)) {
    why << file << " is damaged: its last line must be its checksum, `crc32` and eight digits; " << kind.what
        << " again";
    return false;
  }
  Text computed, stated;
  checksum = crc32(content, size - LAST_LINE);
  put_checksum(computed, checksum);
  for (size_t i = 0; i < 8; ++i) {
    const char digit[2] = {last[sizeof CHECKSUM - 1 + i], '\0'};
    stated << digit;
  }
  if (strcmp(computed.get(), stated.get()) != 0 || last[LAST_LINE - 1] != '\n') {
    why << file << " is damaged: its last line states the checksum ";
    why.quote(stated.get()) << ", its content gives " << computed << "; " << kind.what
                            << " again with `shipcollision prepare " << kind.argument << "`";
    return false;
  }
  return true;
}

// FOLDER/NAME SUFFIX; false for one that is too long.
bool join(const char* folder, const char* name, const char* suffix, char (&path)[LONGEST_PATH]) {
  const char* const parts[] = {folder, folder[0] == '\0' || ends_with_slash(folder) ? "" : "/", name, suffix};
  size_t size = 0;
  for (const char* part : parts) {
    const size_t more = strlen(part);
    if (size + more >= sizeof path) return false;
    memcpy(path + size, part, more);
    size += more;
  }
  path[size] = '\0';
  return true;
}

bool is_below(const char* path, const char* directory) { return directory[0] != '\0' && !is_absolute(path); }

}  // namespace

bool is_absolute(const char* path) {
  return path[0] == '/' || path[0] == '\\' || (path[0] != '\0' && path[1] == ':');
}

bool read_below(const char* folder, const char* name, const char* suffix, FileContent& content) {
  char path[LONGEST_PATH];
  Text unread;
  return join(folder, name, suffix, path) && content.read(path, LONGEST_FILE, unread);
}

bool read_prepared_file(const char* path, const char* directory, FileContent& content) {
  return (is_below(path, directory) && read_below(directory, path, "", content)) || read_below("", path, "", content);
}

bool is_prepared_folder(const char* path, const char* directory) {
  char below[LONGEST_PATH];
  return (is_below(path, directory) && join(directory, path, "", below) && is_folder(below)) || is_folder(path);
}

bool check_prepared(const PreparedKind& kind, const char* content, size_t size, const char* file, uint32_t& checksum,
                    Text& why) {
  return check_first_line(kind, content, size, file, why) && check_checksum(kind, content, size, file, checksum, why);
}

PreparedLines::PreparedLines(char* content, size_t size) : reader_(content, size - LAST_LINE) { reader_.next_line(); }

bool PreparedLines::check(const PreparedKind& kind, const char* file, Text& why) const {
  if (is_good()) return true;
  why << file << " is damaged: line " << number_ << " must be the key ";
  why.quote(expected_) << " with its values; " << kind.what << " again";
  return false;
}

int PreparedLines::read_count(const char* key, long long most) {
  long long count = 0;
  if (begin(key) && !(reader_.whole(count) && 0 <= count && count <= most && reader_.is_end_of_line())) refuse(key);
  return is_good() ? static_cast<int>(count) : 0;
}

void PreparedLines::read_hull(HullMesh& hull, Text* refusal) {
  hull.clear();
  if (!begin("hull")) return;
  if (refusal != nullptr && reader_.word("refused")) {
    if (!take_text(*refusal) || refusal->is_empty()) refuse("hull");
    return;
  }
  long long count = 0;
  if (reader_.whole(count) && 0 < count && count <= MOST_PARTS && take_real(hull.reach) && take_real(hull.extent) &&
      reader_.is_end_of_line()) {
    read_parts(static_cast<int>(count), hull);
  } else {
    refuse("hull");
  }
}

void PreparedLines::read_parts(int count, HullMesh& hull) {
  for (int i = 0; i < count && is_good(); ++i) {
    bool is_kept = begin("part") && !reader_.is_end_of_line();
    for (Three corner; is_kept && !reader_.is_end_of_line();) is_kept = take_numbers(corner) && hull.add_corner(corner);
    if (!is_kept && is_good()) refuse("part");
    is_kept = begin("planes") && !reader_.is_end_of_line();
    for (HalfSpace plane; is_kept && !reader_.is_end_of_line();) is_kept = take_numbers(plane) && hull.add_plane(plane);
    if (!(is_kept && hull.end_part()) && is_good()) refuse("planes");
  }
}

bool PreparedLines::begin(const char* key) {
  if (!is_good()) return false;
  ++number_;
  if (reader_.next_line() && reader_.word(key)) return true;
  refuse(key);
  return false;
}

bool PreparedLines::take_real(double& number) { return reader_.real(number) && isfinite(number); }

bool PreparedLines::take_text(Text& text) {
  const char* words;
  text.clear();
  if (!reader_.text(words)) return false;
  text << words;
  return reader_.is_end_of_line();
}

}  // namespace shipcollision
