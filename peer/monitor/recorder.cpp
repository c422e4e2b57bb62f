// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/recorder.hpp"

#include "peer/monitor/held_rows.hpp"
#include "proto/net/detached_thread.hpp"
#include "proto/net/keeper.hpp"
#include "proto/record/header.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <readerwriterqueue/readerwritercircularbuffer.h>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <utility>

namespace hapnet::peer::monitor {

struct Recorder::State {
    explicit State(Setup setup)
        : writer{std::move(setup.writer)}, span{setup.held}, keeper{setup.keep_in}
    {
        if (!span) return;
        peer_id = setup.config.value("peer_id", 0);
        held.emplace(*span, setup.layout);
        setup.config["begins_late"] = true;
        kept_head = record::header_line(setup.config, setup.layout) + '\n';
    }

    /// Runs on the writing thread.
    void work()
    {
        record::Row row;
        while (true) {
            const bool was_closed = is_closed.load(std::memory_order_acquire);
            if (rows.wait_dequeue_timed(row, std::chrono::milliseconds{20})) {
                if (held) held->add(row);
                write(row);
            } else {
                save_ordered();
                if (was_closed) break;
            }
            if (++taken % rows_between_looks == 0) save_ordered();
        }
        close_file();
        is_done.store(true, std::memory_order_release);
    }

    /// Writes a row. It may block forever, like every operation on the file.
    void write(const record::Row& row)
    {
        if (has_failed.load(std::memory_order_relaxed)) {
            lost.fetch_add(1, std::memory_order_relaxed);
            return;
        }
        if (!writer) return;
        ++given;
        try {
            writer->write(row);
            written.fetch_add(1, std::memory_order_relaxed);
        } catch (const std::system_error&) {
            fail();
        }
    }

    void close_file()
    {
        if (!writer) return;
        try {
            writer->flush();
        } catch (const std::system_error&) {
            fail();
        }
        writer.reset();
    }

    /// Ends the record with the rows that are already in the file.
    void fail()
    {
        lost.fetch_add(given - writer->rows(), std::memory_order_relaxed);
        failure = std::current_exception();
        has_failed.store(true, std::memory_order_release);
    }

    void save_ordered()
    {
        if (!held) return;
        if (const auto order = keeper.take()) {
            keeper.save(order->path, kept_head + held->since(order->from));
        }
    }

    static constexpr std::uint64_t rows_between_looks = 64; // 30 ms with two peers

    // The members up to `given` belong to the writing thread alone.
    std::optional<record::Writer> writer;
    std::optional<HeldRows> held;
    std::string kept_head; // first line of a file with held rows
    std::uint64_t taken = 0;
    std::uint64_t given = 0; // rows given to the writer
    const std::optional<base::Duration> span;
    std::int64_t peer_id = 0;
    net::Keeper keeper;
    moodycamel::BlockingReaderWriterCircularBuffer<record::Row> rows{rows_max};
    std::atomic<std::uint64_t> written{0};
    std::atomic<std::uint64_t> lost{0};
    std::exception_ptr failure; // valid once has_failed is true
    std::atomic<bool> has_failed{false};
    std::atomic<bool> is_closed{false};
    std::atomic<bool> is_done{false};
};

Recorder::Recorder(Setup setup) : state_{std::make_shared<State>(std::move(setup))}
{
    net::start_detached([state = state_] { state->work(); });
}

Recorder::~Recorder() { close(); }

void Recorder::put(const record::Row& row)
{
    if (!state_->rows.try_enqueue(row)) state_->lost.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::close() { state_->is_closed.store(true, std::memory_order_release); }

std::optional<base::Duration> Recorder::held() const { return state_->span; }

base::Result<std::string> Recorder::keep(const std::string& name, base::TimePoint from)
{
    return state_->keeper.order(fmt::format("{}-peer-{}.rec", name, state_->peer_id), from);
}

std::optional<std::string> Recorder::keep_trouble() { return state_->keeper.trouble(); }

bool Recorder::is_done() const { return state_->is_done.load(std::memory_order_acquire); }

std::exception_ptr Recorder::failure() const
{
    return state_->has_failed.load(std::memory_order_acquire) ? state_->failure : nullptr;
}

std::uint64_t Recorder::lost() const { return state_->lost.load(std::memory_order_relaxed); }

std::uint64_t Recorder::written() const { return state_->written.load(std::memory_order_relaxed); }

} // namespace hapnet::peer::monitor
