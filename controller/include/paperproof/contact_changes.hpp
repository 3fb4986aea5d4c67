/// Which contacts begin in a step, which go on, and which have ended.
#pragma once

#include <paperproof/technique.hpp>

#include <algorithm>
#include <cstdint>
#include <span>

namespace paperproof {

enum class ContactChange : std::uint8_t { added, persisted, removed };

/// Calls `visit(change, contact)` for each collider of two steps once, with its first contact: those of this step in
/// their order, then those that are `removed`, with their contact of the step before. Ids of a `Level` tell a collider
/// that was replaced from the one before.
/// @param before the contacts of the step before: a copy of its `move.contacts`. @param now those of this step.
template <class Scalar, class Visit>
void for_each_change(std::span<const Contact<Scalar>> before, std::span<const Contact<Scalar>> now,
                     const Visit& visit) {
  const auto is_in = [](std::span<const Contact<Scalar>> contacts, ColliderIndex collider) {
    return std::any_of(contacts.begin(), contacts.end(),
                       [&](const Contact<Scalar>& contact) { return contact.collider == collider; });
  };
  const auto visit_first_of = [&](std::span<const Contact<Scalar>> contacts, const auto& change_of) {
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (!is_in(contacts.first(i), contacts[i].collider)) change_of(contacts[i]);
  };
  visit_first_of(now, [&](const Contact<Scalar>& contact) {
    visit(is_in(before, contact.collider) ? ContactChange::persisted : ContactChange::added, contact);
  });
  visit_first_of(before, [&](const Contact<Scalar>& contact) {
    if (!is_in(now, contact.collider)) visit(ContactChange::removed, contact);
  });
}

}  // namespace paperproof
