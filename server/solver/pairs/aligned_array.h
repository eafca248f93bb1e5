// Plain numbers at addresses that whole vectors can be loaded from.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace headrace::solver {

template <class T>
class AlignedArray {
  public:
    static constexpr std::size_t kAlignment = 64;  // bytes, a cache line and the longest vector

    // Keeps nothing of what was there where it must grow.
    void resize(std::size_t size) {
        if (size > capacity_) {
            data_.reset();  // before there is another
            capacity_ = size + size / 8;
            data_.reset(static_cast<T*>(::operator new[](capacity_ * sizeof(T), std::align_val_t{kAlignment})));
        }
        size_ = size;
    }

    std::size_t size() const { return size_; }
    T* data() { return data_.get(); }
    const T* data() const { return data_.get(); }
    T& operator[](std::size_t k) { return data_[static_cast<std::ptrdiff_t>(k)]; }
    const T& operator[](std::size_t k) const { return data_[static_cast<std::ptrdiff_t>(k)]; }

  private:
    struct Free {
        void operator()(T* data) const { ::operator delete[](data, std::align_val_t{kAlignment}); }
    };
    std::size_t size_{}, capacity_{};
    std::unique_ptr<T[], Free> data_;
};

}  // namespace headrace::solver
