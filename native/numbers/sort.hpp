// Sorting without memory. is_before(p, q): whether p belongs before q.
#pragma once

namespace shipcollision {

// Leaves equal entries in their order. For short lists: time grows with the square of their length.
template <typename T, typename IsBefore>
void sort_stably(T* entries, int count, IsBefore is_before) {
  for (int i = 1; i < count; ++i) {
    const T entry = entries[i];
    int k = i;
    for (; k > 0 && is_before(entry, entries[k - 1]); --k) entries[k] = entries[k - 1];
    entries[k] = entry;
  }
}

// Heapsort: the order of equal entries is any, yet the same on every platform.
template <typename T, typename IsBefore>
void sort(T* entries, int count, IsBefore is_before) {
  if (count < 16) return sort_stably(entries, count, is_before);
  for (int begin = count / 2, end = count; end > 1;) {
    if (begin > 0) {
      --begin;
    } else {
      --end;
      const T top = entries[0];
      entries[0] = entries[end];
      entries[end] = top;
    }
    const T sinking = entries[begin];
    int at = begin;
    for (int child = 2 * at + 1; child < end; child = 2 * at + 1) {
      if (child + 1 < end && is_before(entries[child], entries[child + 1])) ++child;
      if (!is_before(sinking, entries[child])) break;
      entries[at] = entries[child];
      at = child;
    }
    entries[at] = sinking;
  }
}

}  // namespace shipcollision
