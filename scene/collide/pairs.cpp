// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/pairs.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::scene {

bool touches(const ContactMemory& memory)
{
    for (std::uint32_t i = 0; i < memory.count; ++i)
        if (memory.normal_impulse[i] > 0.0) return true;
    return false;
}

PairSet::PairSet(Room room)
    : pairs_{room.pairs_max},
      links_{room.pairs_max},
      keys_{room.pairs_max},
      marks_{room.pairs_max},
      free_{room.pairs_max},
      first_(room.firsts, none),
      second_(room.seconds, none),
      active_{room.pairs_max},
      arriving_{room.pairs_max},
      added_{room.pairs_max},
      parked_{room.pairs_max},
      removed_{room.pairs_max}
{}

bool PairSet::add(std::uint32_t a, std::uint32_t b, bool is_active)
{
    if (pairs_.is_full() && free_.is_empty()) apply_changes(); // removed pairs make room
    if (pairs_.is_full() && free_.is_empty()) {
        ++left_out_;
        return false;
    }
    PairIndex index = 0;
    if (free_.is_empty()) {
        index = static_cast<PairIndex>(pairs_.size());
        pairs_.add({});
        links_.add({});
        keys_.add(0);
        marks_.add(0);
    } else {
        index = free_.take_last();
    }
    pairs_[index] = {a, b, {}};
    keys_[index] = std::uint64_t{a} << 32U | b;
    marks_[index] = 0;
    link(index);
    if (is_active) set_active(index, true);
    ++size_;
    return true;
}

void PairSet::remove(PairIndex index)
{
    unlink(index);
    --size_;
    if ((marks_[index] & listed) == 0) {
        free_.add(index);
        return;
    }
    set_active(index, false);
    removed_.add(index); // its index is free once it is off the list
}

void PairSet::set_active(PairIndex index, bool is_active)
{
    std::uint8_t& mark = marks_[index];
    if (is_active) {
        if ((mark & listed) == 0) arriving_.add(index);
        mark |= active_mark | listed;
        return;
    }
    if ((mark & listed) != 0 && (mark & parking) == 0) {
        parked_.add(index);
        mark |= parking;
    }
    mark &= static_cast<std::uint8_t>(~active_mark);
}

void PairSet::apply_changes()
{
    added_.clear();
    if (!parked_.is_empty()) drop_parked();
    if (!arriving_.is_empty()) merge_arriving();
    for (const PairIndex index : removed_) free_.add(index);
    removed_.clear();
}

/// Returns the place of a pair in a sorted part of the list of active pairs, or the place where it
/// would be.
PairIndex* PairSet::find(PairIndex* first, PairIndex* last, PairIndex index) const
{
    return std::lower_bound(first, last, index,
                            [this](PairIndex x, PairIndex y) { return keys_[x] < keys_[y]; });
}

/// Removes parked pairs from the list. It moves the stretches between them one by one: most of a
/// long list stays as it is.
void PairSet::drop_parked()
{
    std::sort(parked_.begin(), parked_.end(),
              [this](PairIndex x, PairIndex y) { return keys_[x] < keys_[y]; });
    PairIndex* to = nullptr;
    PairIndex* from = active_.begin();
    for (const PairIndex index : parked_) {
        marks_[index] &= static_cast<std::uint8_t>(~parking);
        if (is_active(index)) continue; // the pair is active again
        PairIndex* const place = find(from, active_.end(), index);
        if (place == active_.end() || *place != index) continue; // the pair is still in arriving_
        to = to == nullptr ? place : std::copy(from, place, to);
        from = place + 1;
        marks_[index] = 0;
    }
    if (to != nullptr) to = std::copy(from, active_.end(), to);
    if (to != nullptr) active_.resize(static_cast<std::size_t>(to - active_.begin()));
    parked_.clear();
    std::size_t kept = 0;
    for (const PairIndex index : arriving_) {
        if (is_active(index))
            arriving_[kept++] = index;
        else
            marks_[index] = 0;
    }
    arriving_.resize(kept);
}

void PairSet::merge_arriving()
{
    std::sort(arriving_.begin(), arriving_.end(),
              [this](PairIndex x, PairIndex y) { return keys_[x] < keys_[y]; });
    // The merge goes from the back, so that the part before the first new pair stays as it is.
    PairIndex* from = active_.begin() + active_.size();
    active_.resize(active_.size() + arriving_.size());
    PairIndex* to = active_.end();
    for (std::size_t i = arriving_.size(); i > 0; --i) {
        const PairIndex index = arriving_[i - 1];
        PairIndex* const place = find(active_.begin(), from, index);
        to = std::copy_backward(place, from, to);
        *--to = index;
        from = place;
    }
    std::swap(added_, arriving_);
    arriving_.clear();
}

void PairSet::link(PairIndex index)
{
    const Pair& pair = pairs_[index];
    Links& own = links_[index];
    own = {.next_first = first_[pair.a], .next_second = second_[pair.b]};
    if (own.next_first != none) links_[own.next_first].previous_first = index;
    if (own.next_second != none) links_[own.next_second].previous_second = index;
    first_[pair.a] = index;
    second_[pair.b] = index;
}

void PairSet::unlink(PairIndex index)
{
    const Pair& pair = pairs_[index];
    const Links& own = links_[index];
    if (own.next_first != none) links_[own.next_first].previous_first = own.previous_first;
    if (own.next_second != none) links_[own.next_second].previous_second = own.previous_second;
    (own.previous_first != none ? links_[own.previous_first].next_first : first_[pair.a]) =
        own.next_first;
    (own.previous_second != none ? links_[own.previous_second].next_second : second_[pair.b]) =
        own.next_second;
}

} // namespace hapnet::scene
