#include "fender_ledger.hpp"

#include "dynamics/delassus.hpp"

namespace shipcollision {

void select_fenders(const Bodies& bodies, const Buffer<NearPair>& near, Buffer<FenderPair>& fenders) {
  fenders.clear();
  for (const NearPair& each : near) {
    const Body &a = bodies[each.pair.a], &b = bodies[each.pair.b];
    if (a.has_fender && b.has_fender) {
      fenders.add({each.pair, combine_in_series(a.fender, b.fender)});
    } else if (a.has_fender || b.has_fender) {
      fenders.add({each.pair, a.has_fender ? a.fender : b.fender});
    }
  }
}

FenderOutput FenderLedger::energy() const {
  double stored = 0.0;
  for (const Stored& each : stored_) stored += each.energy;
  return {stored, dissipated_};
}

void FenderLedger::press(const Buffer<FenderPair>& fenders, Detector& detector, const LastNormals& last_normals,
                         BodyState* states, double friction, double h, ContactPoints& points) {
  for (const auto& [pair, fender] : fenders) {
    Contact contact;
    if (!detector.facing(pair, fender.thickness, states, last_normals, contact) ||
        fender.thickness - contact.gap <= 0.0) {
      release(pair);
    } else {
      press_one(fender, contact, states, friction, h, points);
    }
  }
}

FenderLedger::Stored* FenderLedger::find(const Pair& pair) {
  for (Stored& each : stored_) {
    if (each.pair == pair) return &each;
  }
  return nullptr;
}

// End of compression: what the spring still holds is dissipated.
void FenderLedger::release(const Pair& pair) {
  for (int i = 0; i < stored_.size(); ++i) {
    if (!(stored_[i].pair == pair)) continue;
    dissipated_ += stored_[i].energy;
    stored_.remove(i);
    return;
  }
}

// Books the impulse of a compressed fender, and its energy. contact: its gap is that of the hulls.
void FenderLedger::press_one(const Fender& fender, const Contact& contact, BodyState* states, double friction, double h,
                             ContactPoints& points) {
  const Pair pair{contact.a, contact.b};
  Stored* stored = find(pair);
  if (stored == nullptr) {
    if (!stored_.add({pair, 0.0})) return;
    stored = &stored_.last();
  }
  const Rows W = find_mobility(contact, states);
  const Three v = rotate(contact.axes, energy_velocity(contact, states));
  const Compression compressed =
      compress_fender(fender, fender.thickness - contact.gap, -v[0], W[0][0], stored->energy, h);
  const double slip[2] = {v[1] + compressed.P * W[1][0], v[2] + compressed.P * W[2][0]};
  double P_t[2];
  solve_friction(W, slip, friction, compressed.P, P_t);
  const Impulse impulse{contact, compressed.P * contact.normal + P_t[0] * contact.axes[1] + P_t[1] * contact.axes[2]};
  Booked booked;
  book_impulses(&impulse, 1, states, &booked);
  dissipated_ += booked.lost - (compressed.stored - stored->energy);
  stored->energy = compressed.stored;
  points.merge_contact_point(impulse, booked.lost);
}

void FenderLedger::get_state(ByteWriter& bytes) const {
  bytes.list(stored_);
  bytes.value(dissipated_);
}

bool FenderLedger::set_state(ByteReader& bytes) { return bytes.list(stored_) && bytes.value(dissipated_); }

}  // namespace shipcollision
