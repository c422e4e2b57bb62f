// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/recorder.hpp"

#include "proto/net/detached_thread.hpp"

#include <atomic>
#include <chrono>
#include <optional>
#include <readerwriterqueue/readerwritercircularbuffer.h>
#include <system_error>
#include <utility>

namespace hapnet::peer::monitor {

struct Recorder::State {
    explicit State(record::Writer to) : writer{std::move(to)} {}

    /// The writing thread.
    void work()
    {
        try {
            record::Row row;
            while (true) {
                const bool was_closed = is_closed.load(std::memory_order_acquire);
                if (rows.wait_dequeue_timed(row, std::chrono::milliseconds{20})) {
                    writer->write(row); // may take for ever, as all that the file is asked
                    written.fetch_add(1, std::memory_order_relaxed);
                } else if (was_closed) {
                    break;
                }
            }
            writer->flush();
        } catch (const std::system_error&) {
            failure = std::current_exception();
            has_failed.store(true, std::memory_order_release);
        }
        writer.reset(); // closes it
        is_done.store(true, std::memory_order_release);
    }

    std::optional<record::Writer> writer; // the thread's own
    moodycamel::BlockingReaderWriterCircularBuffer<record::Row> rows{rows_max};
    std::atomic<std::uint64_t> written{0};
    std::atomic<std::uint64_t> lost{0};
    std::exception_ptr failure; // once it has failed
    std::atomic<bool> has_failed{false};
    std::atomic<bool> is_closed{false};
    std::atomic<bool> is_done{false};
};

Recorder::Recorder(record::Writer writer) : state_{std::make_shared<State>(std::move(writer))}
{
    net::start_detached([state = state_] { state->work(); });
}

Recorder::~Recorder() { close(); }

void Recorder::put(const record::Row& row)
{
    if (state_->has_failed.load(std::memory_order_acquire)) return;
    if (!state_->rows.try_enqueue(row)) state_->lost.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::close() { state_->is_closed.store(true, std::memory_order_release); }

bool Recorder::is_done() const { return state_->is_done.load(std::memory_order_acquire); }

std::exception_ptr Recorder::failure() const
{
    return state_->has_failed.load(std::memory_order_acquire) ? state_->failure : nullptr;
}

std::uint64_t Recorder::lost() const { return state_->lost.load(std::memory_order_relaxed); }

std::uint64_t Recorder::written() const { return state_->written.load(std::memory_order_relaxed); }

} // namespace hapnet::peer::monitor
