/// Vectors for the report of a step: mostly a handful of elements, but only the scenery bounds their number.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

namespace paperproof {

/// Memory in which a `ReportVector` continues when its inline storage is full. It is reserved, and not touched before
/// it is needed.
template <class T>
class ReportMemory {
 public:
  ReportMemory() = default;
  explicit ReportMemory(std::size_t capacity) : bytes_(new std::byte[capacity * sizeof(T)]), capacity_(capacity) {}
  [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }
  [[nodiscard]] T* data() const noexcept { return static_cast<T*>(static_cast<void*>(bytes_.get())); }

 private:
  std::unique_ptr<std::byte[]> bytes_;  // NOLINT(*-avoid-c-arrays): not initialised, as no standard container is
  std::size_t capacity_ = 0;
};

/// A vector with inline storage for the usual number of elements. It continues in memory that is reserved for the
/// largest possible number, so a step never allocates, and no element is left out. Elements past `size()` are not
/// initialised.
///
/// Operations of every step are inlined; rare operations are kept out of line. This saves 2 % of a step at rest.
template <class T, std::size_t Inline>
class SpillVector {
 public:
  // The union is what keeps elements from being initialised before they are there.
  SpillVector() noexcept { items_ = inline_.data(); }
  SpillVector(const SpillVector&) = delete;
  SpillVector& operator=(const SpillVector&) = delete;

  /// Returns false if the vector is full, and remembers the refusal.
  [[gnu::always_inline]] bool push_back(const T& value) noexcept {
    if (size_ == capacity_) [[unlikely]] {
      state_ |= overflow;
      return false;
    }
    std::construct_at(items_ + size_++, value);
    return true;
  }
  /// If the vector is full, it first moves to `more`.
  [[gnu::always_inline]] bool push_back(const T& value, const ReportMemory<T>& more) noexcept {
    if (size_ == capacity_) [[unlikely]]
      go_on_in(more);
    return push_back(value);
  }
  [[gnu::always_inline]] void clear() noexcept {
    if (state_ != 0) [[unlikely]]
      go_home();
    size_ = 0;
  }
  void pop_back() noexcept {
    assert(size_ > 0);
    --size_;
  }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  /// An element was refused: the vector is not complete.
  [[nodiscard]] bool overflowed() const noexcept { return (state_ & overflow) != 0; }
  [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }
  [[nodiscard]] T& operator[](std::size_t i) noexcept { return items_[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const noexcept { return items_[i]; }
  [[nodiscard]] T& back() noexcept { return items_[size_ - 1]; }
  [[nodiscard]] const T& back() const noexcept { return items_[size_ - 1]; }
  [[nodiscard]] T* begin() noexcept { return items_; }
  [[nodiscard]] T* end() noexcept { return items_ + size_; }
  [[nodiscard]] const T* begin() const noexcept { return items_; }
  [[nodiscard]] const T* end() const noexcept { return items_ + size_; }

 protected:
  static_assert(std::is_trivially_destructible_v<T>);
  enum State : std::uint8_t { overflow = 1, borrows = 2, owns = 4 };

  /// @param memory holds the elements (if any) from here on.
  void move_to(T* memory, std::size_t capacity, State kind) noexcept {
    std::uninitialized_copy(begin(), end(), memory);
    items_ = memory;
    capacity_ = capacity;
    state_ |= kind;
  }
  /// Leaves borrowed memory. Its elements are forgotten.
  [[gnu::cold, gnu::noinline]] void go_home() noexcept {
    items_ = inline_.data();
    capacity_ = Inline;
    state_ = 0;
  }

  T* items_;
  std::size_t size_ = 0;
  std::size_t capacity_ = Inline;
  std::uint8_t state_ = 0;

 private:
  [[gnu::cold, gnu::noinline]] void go_on_in(const ReportMemory<T>& more) noexcept {
    if ((state_ & borrows) == 0 && more.capacity() > capacity_) move_to(more.data(), more.capacity(), borrows);
  }
  union {
    std::array<T, Inline> inline_;
  };
};

/// Elements beyond the inline storage are in the scratch of the step: read them before that scratch is used again. A
/// copy keeps all its elements itself, and may allocate for them.
template <class T, std::size_t Inline>
class ReportVector : public SpillVector<T, Inline> {
  using Base = SpillVector<T, Inline>;

 public:
  ReportVector() noexcept = default;
  ReportVector(const ReportVector& other) : Base() { *this = other; }
  ReportVector& operator=(const ReportVector& other) {
    if (this == &other) return *this;
    clear();
    reserve(other.size_);
    std::uninitialized_copy(other.begin(), other.end(), this->items_);
    this->size_ = other.size_;
    if (other.overflowed()) this->state_ |= Base::overflow;
    return *this;
  }
  [[gnu::always_inline]] void clear() noexcept {
    if (this->state_ != 0) [[unlikely]]
      go_home();
    this->size_ = 0;
  }
  /// Reserves own memory for `capacity` elements: up to this number, copies and additions allocate nothing.
  void reserve(std::size_t capacity) {
    if (capacity <= this->capacity_) return;
    ReportMemory<T> own(capacity);
    this->move_to(own.data(), capacity, Base::owns);
    own_ = std::move(own);
  }
  /// Leaves borrowed memory, because others will use it. Keeps as many elements as its own memory holds; `overflowed()`
  /// if these are not all.
  void keep_own() noexcept {
    if ((this->state_ & Base::borrows) == 0) return;
    const T* const borrowed = this->items_;
    const std::size_t size = this->size_;
    clear();
    this->size_ = std::min(size, this->capacity_);
    if (this->size_ < size) this->state_ |= Base::overflow;
    std::uninitialized_copy(borrowed, borrowed + this->size_, this->items_);
  }
  friend bool operator==(const ReportVector& a, const ReportVector& b) noexcept {
    return a.overflowed() == b.overflowed() && std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  [[gnu::cold, gnu::noinline]] void go_home() noexcept {
    Base::go_home();
    this->size_ = 0;
    if (own_.capacity() > 0) this->move_to(own_.data(), own_.capacity(), Base::owns);
  }
  ReportMemory<T> own_;
};

}  // namespace paperproof
