// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/broadphase/pairs.hpp"

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
      coming_{room.pairs_max},
      added_{room.pairs_max},
      going_{room.pairs_max}
{}

bool PairSet::add(std::uint32_t a, std::uint32_t b, bool is_active)
{
    if (pairs_.is_full() && free_.is_empty()) settle(); // what was removed makes room
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
    marks_[index] = listed; // its place is free once it is off the list
    going_.add(index);
    has_parked_ = true;
}

void PairSet::set_active(PairIndex index, bool is_active)
{
    if (!is_active) {
        marks_[index] &= listed;
        has_parked_ = true;
        return;
    }
    if ((marks_[index] & listed) == 0) coming_.add(index);
    marks_[index] = active_mark | listed;
}

void PairSet::settle()
{
    added_.clear();
    if (has_parked_) drop_parked();
    if (!coming_.is_empty()) merge_coming();
    for (const PairIndex index : going_) free_.add(index);
    going_.clear();
}

void PairSet::drop_parked()
{
    has_parked_ = false;
    for (Bounded<PairIndex>* list : {&active_, &coming_}) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < list->size(); ++i) {
            const PairIndex index = (*list)[i];
            if (is_active(index))
                (*list)[kept++] = index;
            else
                marks_[index] = 0;
        }
        list->resize(kept);
    }
}

void PairSet::merge_coming()
{
    const auto before = [this](PairIndex x, PairIndex y) { return keys_[x] < keys_[y]; };
    std::sort(coming_.begin(), coming_.end(), before);
    // From the back, so that what lies before the first to come is not touched.
    std::size_t from = active_.size();
    std::size_t coming = coming_.size();
    std::size_t to = from + coming;
    active_.resize(to);
    while (coming > 0) {
        if (from > 0 && before(coming_[coming - 1], active_[from - 1]))
            active_[--to] = active_[--from];
        else
            active_[--to] = coming_[--coming];
    }
    std::swap(added_, coming_);
    coming_.clear();
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
