// Prints the closest points of hulls read from standard input, all numbers as the 16 hexadecimal digits of their bits.
//
// Input: how many ships; of each the number of parts; of each part the number of corners; coordinates of all corners.
// Then questions: ship a, its pose (12 numbers), ship b, its pose, and the distance. Output: a line per closest point,
// and one with "." after each question.
#include "collision/geometry/closest_points.hpp"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

namespace {

bool read_integer(int& number) { return scanf("%d", &number) == 1; }

double read_double() {
  unsigned long long bits = 0;
  if (scanf("%llx", &bits) != 1) exit(1);
  double number;
  memcpy(&number, &bits, sizeof number);
  return number;
}

void print_double(double number) {
  unsigned long long bits;
  memcpy(&bits, &number, sizeof bits);
  printf("%016llx ", bits);
}

int* read_integers(int count) {
  int* numbers = static_cast<int*>(calloc(static_cast<size_t>(count) + 1, sizeof(int)));
  for (int i = 0; i < count; ++i) read_integer(numbers[i]);
  return numbers;
}

int sum(const int* numbers, int count) {
  int total = 0;
  for (int i = 0; i < count; ++i) total += numbers[i];
  return total;
}

void place(shipcollision::PlacedHulls& hulls, int& ship) {
  if (!read_integer(ship)) exit(0);
  double pose[12];
  for (double& number : pose) number = read_double();
  hulls.place(ship, pose, pose + 3);
}

}  // namespace

int main() {
  int ships = 0;
  if (!read_integer(ships)) return 1;
  const int* parts = read_integers(ships);
  const int count = sum(parts, ships);
  const int* corners = read_integers(count);
  const int size = 3 * sum(corners, count);
  auto* coordinates = static_cast<double*>(calloc(static_cast<size_t>(size), sizeof(double)));
  for (int i = 0; i < size; ++i) coordinates[i] = read_double();
  shipcollision::PlacedHulls hulls(ships, parts, corners, coordinates);
  auto* found = static_cast<shipcollision::Closest*>(calloc(10000, sizeof(shipcollision::Closest)));
  for (;;) {
    int a = 0, b = 0;
    place(hulls, a);
    place(hulls, b);
    const int rows = hulls.closest(a, b, read_double(), found);
    for (int i = 0; i < rows; ++i) {
      for (double number : found[i].on_a.at) print_double(number);
      for (double number : found[i].on_b.at) print_double(number);
      for (double number : found[i].normal.at) print_double(number);
      print_double(found[i].gap);
      printf("%d %d\n", found[i].part_a, found[i].part_b);
    }
    printf(".\n");
  }
}
