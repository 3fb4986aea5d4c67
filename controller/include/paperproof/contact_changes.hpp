/// Which contacts begin in a step, which go on, and which have ended.
#pragma once

#include <paperproof/report.hpp>

#include <algorithm>
#include <cstdint>
#include <span>

namespace paperproof {

enum class ContactChange : std::uint8_t { added, persisted, removed };

/// Calls `visit(change, contact)` for each surface of two steps once, with its first contact: those of this step in
/// their order, then those that are `removed`, with their contact of the step before.
/// @param same whether two contacts are with one surface.
template <class AnyContact, class Same, class Visit>
void for_each_change(std::span<const AnyContact> before, std::span<const AnyContact> now, const Same& same,
                     const Visit& visit) {
  const auto is_in = [&](std::span<const AnyContact> contacts, const AnyContact& contact) {
    return std::any_of(contacts.begin(), contacts.end(), [&](const AnyContact& other) { return same(other, contact); });
  };
  const auto visit_first_of = [&](std::span<const AnyContact> contacts, const auto& change_of) {
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (!is_in(contacts.first(i), contacts[i])) change_of(contacts[i]);
  };
  visit_first_of(now, [&](const AnyContact& contact) {
    visit(is_in(before, contact) ? ContactChange::persisted : ContactChange::added, contact);
  });
  visit_first_of(before, [&](const AnyContact& contact) {
    if (!is_in(now, contact)) visit(ContactChange::removed, contact);
  });
}

/// The same by collider. In a `Level` a collider that was replaced keeps its id and counts as the same surface; one
/// that was removed does not.
/// @param before the contacts of the step before: a copy of its `move.contacts`. @param now those of this step.
template <class Visit>
void for_each_change(std::span<const Contact> before, std::span<const Contact> now, const Visit& visit) {
  const auto same = [](const Contact& a, const Contact& b) { return a.collider == b.collider; };
  for_each_change(before, now, same, visit);
}

}  // namespace paperproof
