#include "prepared_obstacles.hpp"

namespace shipcollision {
namespace {

constexpr PreparedKind KIND = {"shipcollision prepared obstacles ", "1", "file of prepared obstacles",
                               "OBSTACLES.toml", "prepare the obstacles"};
constexpr char SUFFIX[] = ".obstacles";
constexpr long long MOST_OBSTACLES = 100000;

struct Place {
  Three position;
  double heading;
};

bool is_blank(const char* text) { return text[strspn(text, " \t\r\n")] == '\0'; }

bool ends_with(const char* text, const char* end) {
  const size_t size = strlen(text), length = strlen(end);
  return size >= length && strcmp(text + size - length, end) == 0;
}

}  // namespace

bool PreparedObstacles::open(const char* path, const char* directory, Text& why) {
  count_ = 0;
  checksum_ = 0;
  if (is_blank(path)) return true;
  if (!ends_with(path, SUFFIX)) {
    why << "obstacles: a native FMU reads no TOML; write prepared obstacles with `shipcollision prepare "
        << KIND.argument << "` and give the path of that file, which ends in " << SUFFIX;
    return false;
  }
  if (!read_prepared_file(path, directory, content_)) {
    why << "obstacles: file " << path
        << (is_prepared_folder(path, directory) ? " is a folder" : " does not exist or cannot be read") << ": give the path of prepared obstacles";
    return false;
  }
  file_.clear();
  file_ << "obstacles: " << path;
  if (!check_prepared(KIND, content_.data(), content_.size(), file_.get(), checksum_, why)) return false;
  lines_ = new PreparedLines(content_.data(), content_.size());
  if (lines_ == nullptr) {
    why << "there is no memory for the obstacles";
    return false;
  }
  count_ = lines_->read_count("count", MOST_OBSTACLES);
  return lines_->check(KIND, file_.get(), why);
}

bool PreparedObstacles::next(Obstacle& obstacle, HullMesh& solid, Text& why) {
  Place place{};
  lines_->read_text("name", obstacle.name);
  lines_->read("place", place);
  obstacle.has_fender = lines_->read_if_there("fender", obstacle.fender);
  lines_->read_hull(solid);
  obstacle.position = place.position;
  obstacle.heading = place.heading;
  return lines_->check(KIND, file_.get(), why);
}

}  // namespace shipcollision
