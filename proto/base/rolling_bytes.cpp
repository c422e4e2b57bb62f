// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/rolling_bytes.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>

namespace hapnet::base {

RollingBytes::RollingBytes(Duration span, std::size_t bytes_max)
    : span_{span}, capacity_{bytes_max}, ring_{new char[bytes_max]}
{
    ensure(span > Duration{0} && bytes_max > 0);
}

void RollingBytes::add(TimePoint at, std::string_view piece)
{
    if (!pieces_.empty()) at = std::max(at, pieces_.back().at);
    while (!pieces_.empty() && pieces_.front().at < at - span_) drop_oldest();
    if (piece.size() > capacity_) return;
    while (capacity_ - used_ < piece.size()) drop_oldest();
    const std::size_t end = (begin_ + used_) % capacity_;
    const std::size_t first = std::min(piece.size(), capacity_ - end);
    std::copy_n(piece.data(), first, ring_.get() + end);
    std::copy_n(piece.data() + first, piece.size() - first, ring_.get());
    used_ += piece.size();
    pieces_.push_back({at, piece.size()});
}

std::string RollingBytes::since(TimePoint from) const
{
    std::size_t skipped = 0;
    for (const Piece& piece : pieces_) {
        if (piece.at >= from) break;
        skipped += piece.bytes;
    }
    const std::size_t begin = (begin_ + skipped) % capacity_;
    const std::size_t bytes = used_ - skipped;
    const std::size_t first = std::min(bytes, capacity_ - begin);
    std::string text;
    text.reserve(bytes);
    text.append(ring_.get() + begin, first);
    text.append(ring_.get(), bytes - first);
    return text;
}

void RollingBytes::drop_oldest()
{
    begin_ = (begin_ + pieces_.front().bytes) % capacity_;
    used_ -= pieces_.front().bytes;
    pieces_.pop_front();
}

} // namespace hapnet::base
