(define (problem parcel) (:domain logistics)
  (:objects paris rome - city  cdg fco - airport  depot - location
            parcel - package  truck1 - truck  plane1 - airplane)
  (:init (in-city cdg paris) (in-city depot paris) (in-city fco rome)
         (at parcel depot) (at truck1 cdg) (at plane1 cdg))
  (:goal (at parcel fco)))
