// Obstacles as `shipcollision prepare` writes them: reads what shipcollision_fmu/collision/prepared_obstacles.py writes.
#pragma once

#include "../ship/prepared_lines.hpp"
#include "fender.hpp"

namespace shipcollision {

struct Obstacle {
  Text name;
  Three position;   // of its b in n [m]
  double heading;   // [rad]
  bool has_fender;
  Fender fender;
};

// The obstacles of a file one after the other.
class PreparedObstacles {
 public:
  PreparedObstacles() = default;
  ~PreparedObstacles() { delete lines_; }
  PreparedObstacles(const PreparedObstacles&) = delete;
  PreparedObstacles& operator=(const PreparedObstacles&) = delete;

  // path: of a prepared file, looked for in `directory` first; empty for no obstacles.
  bool open(const char* path, const char* directory, Text& why);
  int count() const { return count_; }
  uint32_t checksum() const { return checksum_; }  // of the file; 0 without one
  bool next(Obstacle& obstacle, HullMesh& solid, Text& why);

 private:
  FileContent content_;
  PreparedLines* lines_ = nullptr;
  Text file_;
  int count_ = 0;
  uint32_t checksum_ = 0;
};

}  // namespace shipcollision
