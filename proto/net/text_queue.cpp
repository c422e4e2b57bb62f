// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/text_queue.hpp"

#include "proto/net/detached_thread.hpp"

#include <cerrno>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <poll.h>
#include <string>
#include <unistd.h>
#include <utility>

namespace hapnet::net {

struct TextQueue::State {
    explicit State(int to) : descriptor{to} {}

    /// Runs on the writing thread, until the queue has been destroyed and nothing is left.
    void work()
    {
        std::unique_lock lock{mutex};
        while (true) {
            has_changed.wait(lock, [this] { return !texts.empty() || is_closed; });
            if (texts.empty()) return;
            const std::string text = std::move(texts.front());
            texts.pop_front();
            is_writing = true;
            lock.unlock();
            const int failure = write_all(text); // may block without end
            lock.lock();
            is_writing = false;
            waiting_bytes -= text.size();
            if (failure == 0) {
                written += text.size();
                continue;
            }
            ++lost;
            if (error == 0) error = failure;
        }
    }

    /// Returns the error number; 0 if there was no error.
    [[nodiscard]] int write_all(std::string_view text) const
    {
        while (!text.empty()) {
            const auto count = ::write(descriptor, text.data(), text.size());
            if (count > 0) {
                text.remove_prefix(static_cast<std::size_t>(count));
            } else if (count < 0 && errno == EAGAIN) { // another process set O_NONBLOCK
                pollfd polled{descriptor, POLLOUT, 0};
                poll(&polled, 1, -1);
            } else if (count < 0 && errno != EINTR) {
                return errno;
            }
        }
        return 0;
    }

    const int descriptor;
    mutable std::mutex mutex;
    std::condition_variable has_changed;
    std::deque<std::string> texts;
    std::size_t waiting_bytes = 0; // includes the text that is being written
    std::uint64_t written = 0;
    std::uint64_t lost = 0;
    int error = 0;
    bool is_writing = false;
    bool is_closed = false;
};

TextQueue::TextQueue(int descriptor) : state_{std::make_shared<State>(descriptor)}
{
    start_detached([state = state_] { state->work(); });
}

TextQueue::~TextQueue()
{
    const std::lock_guard lock{state_->mutex};
    state_->is_closed = true;
    state_->has_changed.notify_one();
}

void TextQueue::put(std::string_view text)
{
    const std::lock_guard lock{state_->mutex};
    if (state_->waiting_bytes + text.size() > bytes_max) {
        ++state_->lost;
        return;
    }
    state_->waiting_bytes += text.size();
    state_->texts.emplace_back(text);
    state_->has_changed.notify_one();
}

bool TextQueue::is_done() const
{
    const std::lock_guard lock{state_->mutex};
    return state_->texts.empty() && !state_->is_writing;
}

std::uint64_t TextQueue::written() const
{
    const std::lock_guard lock{state_->mutex};
    return state_->written;
}

std::uint64_t TextQueue::lost() const
{
    const std::lock_guard lock{state_->mutex};
    return state_->lost;
}

int TextQueue::error() const
{
    const std::lock_guard lock{state_->mutex};
    return state_->error;
}

} // namespace hapnet::net
