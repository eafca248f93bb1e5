// Work on a row of items by several threads, taken in order. The items in work and those not taken yet are bounded, so
// that memory is.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace headrace::client {

// Owner: one thread, which takes the items; the workers are inside.
template <class Item>
class OrderedWork {
  public:
    using Make = std::function<Item(std::size_t index)>;

    // Items 0 .. count - 1. Each worker is called by one thread of its own, for some of the items, ascending.
    OrderedWork(std::size_t count, std::vector<Make> workers) : count_(count), ahead_(2 * workers.size()) {
        for (Make& worker : workers) threads_.emplace_back([this, make = std::move(worker)] { work(make); });
    }
    ~OrderedWork() {
        stop();
        for (std::thread& thread : threads_) thread.join();
    }
    OrderedWork(const OrderedWork&) = delete;
    OrderedWork& operator=(const OrderedWork&) = delete;

    // Waits for the next item; what its making threw is thrown here. Precondition: not all are taken.
    Item next() {
        std::future<Item> item;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return !begun_.empty(); });
            item = std::move(begun_.front());
            begun_.pop_front();
        }
        item.wait();
        {
            const std::lock_guard lock(mutex_);
            ++taken_;
        }
        changed_.notify_all();
        return item.get();
    }

    // Begins no more items; how many there are now, those taken included.
    std::size_t stop() {
        const std::lock_guard lock(mutex_);
        count_ = next_;
        changed_.notify_all();
        return count_;
    }

  private:
    void work(const Make& make) {
        std::unique_lock lock(mutex_);
        for (;;) {
            changed_.wait(lock, [this] { return next_ >= count_ || next_ < taken_ + ahead_; });
            if (next_ >= count_) return;
            const std::size_t index = next_++;
            std::packaged_task<Item()> task([&make, index] { return make(index); });
            begun_.push_back(task.get_future());
            changed_.notify_all();
            lock.unlock();
            task();
            lock.lock();
        }
    }

    std::mutex mutex_;  // guards all below but threads_
    std::condition_variable changed_;
    std::size_t count_;
    std::size_t ahead_;  // items begun and not taken, at most
    std::size_t next_{0}, taken_{0};
    std::deque<std::future<Item>> begun_;  // ascending; not taken yet
    std::vector<std::thread> threads_;
};

}  // namespace headrace::client
