//! Saving, restoring and serializing under FMI 3.0, and to and from FMI 2.0.

use crate::both::{self, run};
use crate::three::{Host, Three};
use crate::two::{self, bits};
use brinell_fmi::fmi3::Status;

#[test]
fn a_rewound_instance_of_fmi_3_repeats_every_bit_and_so_does_one_from_bytes() {
    both::repeats_when_rewound::<Three>();
    both::continues_from_bytes::<Three>();
}

#[test]
fn a_state_in_bytes_goes_from_one_version_of_fmi_to_the_other() {
    let (three, two) = (Host::started("er16k-tb1"), two::Host::started("er16k-tb1"));
    run(&three, 0, 55);
    let bytes = three.serialize(three.save());
    let state = two.deserialize(&bytes).unwrap();
    assert_eq!(two.restore(state), Status::Ok);
    run(&three, 55, 5);
    run(&two, 55, 5);
    let y = three.reference("shaft.y");
    assert_eq!(bits(&three.get(&[y]).unwrap()), bits(&two.get(&[y]).unwrap()));
    let back = three.deserialize(&two.serialize(two.save())).unwrap();
    assert_eq!(three.restore(back), Status::Ok);
    run(&three, 60, 1);
}

#[test]
fn invented_freed_and_foreign_states_are_errors_under_fmi_3() {
    both::refuses_states_of_nobody::<Three>();
}

#[test]
fn a_state_in_place_of_its_address_is_freed_and_bytes_over_their_handle_are_refused_under_fmi_3() {
    both::frees_a_state_by_value::<Three>();
    both::refuses_bytes_over_their_handle::<Three>();
}
