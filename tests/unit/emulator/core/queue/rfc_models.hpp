// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

// The laws of queues, written as simply as in their RFCs, for comparison with ours.

namespace hapnet::emulator::rfc {

using namespace std::chrono_literals;

struct ModelPacket {
    std::uint64_t number;
    base::TimePoint tstamp;
    std::size_t bytes;
    std::uint32_t flow = 0;
    bool is_ect = false; // ECN-capable transport
    bool is_marked = false;
};

struct ModelQueue {
    std::deque<ModelPacket> packets;
    std::size_t bytes = 0;

    void push(const ModelPacket& packet)
    {
        packets.push_back(packet);
        bytes += packet.bytes;
    }
    std::optional<ModelPacket> pop()
    {
        if (packets.empty()) return std::nullopt;
        const auto packet = packets.front();
        packets.pop_front();
        bytes -= packet.bytes;
        return packet;
    }
};

/// The pseudo-code of RFC 8289, section 5, in its own names, with marks as Linux has them: instead
/// of a drop, and then the datagram is sent.
class CodelOfTheRfc {
public:
    bool enqueue(const ModelPacket& packet, base::TimePoint /*now*/)
    {
        queue_.push(packet);
        return true;
    }

    template <typename Drop>
    std::optional<ModelPacket> dequeue(base::TimePoint now, Drop drop)
    {
        DodequeueResult r = dodequeue(now);
        if (dropping_) {
            if (!r.ok_to_drop) dropping_ = false;
            while (now >= drop_next_ && dropping_) {
                ++count_;
                if (r.p->is_ect) {
                    r.p->is_marked = true;
                    drop_next_ = control_law(drop_next_, count_);
                    return r.p;
                }
                drop(*r.p);
                r = dodequeue(now);
                if (!r.ok_to_drop) {
                    dropping_ = false;
                } else {
                    drop_next_ = control_law(drop_next_, count_);
                }
            }
        } else if (r.ok_to_drop) {
            if (r.p->is_ect) {
                r.p->is_marked = true;
            } else {
                drop(*r.p);
                r = dodequeue(now);
            }
            dropping_ = true;
            const std::uint32_t delta = count_ - lastcount_;
            count_ = 1;
            if (delta > 1 && now - drop_next_ < 16 * interval) count_ = delta;
            drop_next_ = control_law(now, count_);
            lastcount_ = count_;
        }
        return r.p;
    }

    ModelQueue& queue() { return queue_; }

private:
    static constexpr base::Duration target = 5ms;
    static constexpr base::Duration interval = 100ms;

    struct DodequeueResult {
        std::optional<ModelPacket> p;
        bool ok_to_drop = false;
    };

    DodequeueResult dodequeue(base::TimePoint now)
    {
        DodequeueResult r{queue_.pop(), false};
        if (!r.p) {
            first_above_time_ = {};
            return r;
        }
        const auto sojourn_time = now - r.p->tstamp;
        if (sojourn_time < target || queue_.bytes <= 1514) {
            first_above_time_ = {};
        } else if (first_above_time_ == base::TimePoint{}) {
            first_above_time_ = now + interval;
        } else if (now >= first_above_time_) {
            r.ok_to_drop = true;
        }
        return r;
    }

    static base::TimePoint control_law(base::TimePoint t, std::uint32_t count)
    {
        const double part = static_cast<double>(interval.count()) / std::sqrt(count);
        return t + base::Duration{static_cast<base::Duration::rep>(part)};
    }

    ModelQueue queue_;
    base::TimePoint first_above_time_{};
    base::TimePoint drop_next_{};
    std::uint32_t count_ = 0;
    std::uint32_t lastcount_ = 0;
    bool dropping_ = false;
};

/// RFC 8290, section 4, in its own names.
class FqCodelOfTheRfc {
public:
    static constexpr std::uint32_t flows = 16;

    explicit FqCodelOfTheRfc(std::size_t limit) : limit_{limit} {}

    bool enqueue(const ModelPacket& packet, base::TimePoint now)
    {
        const auto flow = packet.flow % flows;
        queues_[flow].enqueue(packet, now);
        const auto is_active = [&](const std::deque<std::uint32_t>& list) {
            return std::find(list.begin(), list.end(), flow) != list.end();
        };
        if (is_active(new_queues_) || is_active(old_queues_)) return true;
        credits_[flow] = quantum;
        new_queues_.push_back(flow);
        return true;
    }

    /// Half of the queue with the largest byte count, up to 64, while the limit is exceeded.
    std::vector<std::uint64_t> evict()
    {
        std::vector<std::uint64_t> dropped;
        const auto bytes = [](CodelOfTheRfc& codel) { return codel.queue().bytes; };
        const auto total = [&] {
            std::size_t sum = 0;
            for (CodelOfTheRfc& codel : queues_) sum += bytes(codel);
            return sum;
        };
        while (total() > limit_) {
            CodelOfTheRfc& fattest = *std::ranges::max_element(queues_, {}, bytes);
            const auto half = bytes(fattest) / 2;
            std::size_t taken = 0;
            for (int i = 0; i == 0 || (i < 64 && taken < half); ++i) {
                const auto packet = fattest.queue().pop();
                taken += packet->bytes;
                dropped.push_back(packet->number);
            }
        }
        return dropped;
    }

    template <typename Drop>
    std::optional<ModelPacket> dequeue(base::TimePoint now, Drop drop)
    {
        while (!new_queues_.empty() || !old_queues_.empty()) {
            auto& list = new_queues_.empty() ? old_queues_ : new_queues_;
            const auto flow = list.front();
            if (credits_[flow] <= 0) {
                credits_[flow] += quantum;
                list.pop_front();
                old_queues_.push_back(flow);
                continue;
            }
            const auto packet = queues_[flow].dequeue(now, drop);
            if (packet) {
                credits_[flow] -= static_cast<int>(packet->bytes);
                return packet;
            }
            const bool was_new = &list == &new_queues_;
            list.pop_front();
            if (was_new) old_queues_.push_back(flow);
        }
        return std::nullopt;
    }

private:
    static constexpr int quantum = 1514;

    std::size_t limit_;
    std::array<CodelOfTheRfc, flows> queues_{};
    std::array<int, flows> credits_{};
    std::deque<std::uint32_t> new_queues_;
    std::deque<std::uint32_t> old_queues_;
};

/// The pseudo-code of RFC 8033, sections 4.1 to 4.4, in its own names.
class PieOfTheRfc {
public:
    explicit PieOfTheRfc(const base::RandomStream& stream) : stream_{stream} {}

    bool enqueue(const ModelPacket& packet, base::TimePoint now)
    {
        tick(now);
        if (drop_prob_ == 0 && current_qdelay_ < ref / 2 && qdelay_old_ < ref / 2) {
            burst_allowance_ = 0.150;
        }
        if (burst_allowance_ <= 1e-9 && drop_early(packet.number)) return false;
        queue_.push(packet);
        return true;
    }

    template <typename Drop>
    std::optional<ModelPacket> dequeue(base::TimePoint now, Drop /*drop*/)
    {
        const auto packet = queue_.pop();
        if (!packet) return packet;
        tick(now);
        current_qdelay_ = base::to_seconds(now - packet->tstamp);
        return packet;
    }

private:
    static constexpr double ref = 0.015;

    void tick(base::TimePoint now)
    {
        if (next_ == base::TimePoint{}) next_ = now + 15ms;
        for (; next_ <= now; next_ += 15ms) calculate_drop_prob();
    }

    bool drop_early(std::uint64_t number)
    {
        if ((qdelay_old_ < ref / 2 && drop_prob_ < 0.2) || queue_.bytes <= 2 * 1024) return false;
        return stream_.uniform(number) < drop_prob_;
    }

    void calculate_drop_prob()
    {
        double p = 0.125 * (current_qdelay_ - ref) + 1.25 * (current_qdelay_ - qdelay_old_);
        if (drop_prob_ < 0.000001) {
            p /= 2048;
        } else if (drop_prob_ < 0.00001) {
            p /= 512;
        } else if (drop_prob_ < 0.0001) {
            p /= 128;
        } else if (drop_prob_ < 0.001) {
            p /= 32;
        } else if (drop_prob_ < 0.01) {
            p /= 8;
        } else if (drop_prob_ < 0.1) {
            p /= 2;
        }
        if (drop_prob_ >= 0.1 && p > 0.02) p = 0.02;
        drop_prob_ += p;
        if (current_qdelay_ == 0 && qdelay_old_ == 0) drop_prob_ *= 0.98;
        if (drop_prob_ < 0) drop_prob_ = 0;
        if (drop_prob_ > 1) drop_prob_ = 1;
        qdelay_old_ = current_qdelay_;
        burst_allowance_ = std::max(0.0, burst_allowance_ - 0.015);
    }

    base::RandomStream stream_;
    ModelQueue queue_;
    base::TimePoint next_{};
    double current_qdelay_ = 0.0;
    double qdelay_old_ = 0.0;
    double drop_prob_ = 0.0;
    double burst_allowance_ = 0.0;
};

} // namespace hapnet::emulator::rfc
