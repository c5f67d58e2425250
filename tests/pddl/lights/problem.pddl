(define (problem see-the-attic) (:domain lights)
  (:objects robot - robot attic - room s1 s2 - switch)
  (:init (is-in robot hall) (wired s1 attic) (wired s2 hall) (broken s2) (seen robot))
  (:goal (and (seen attic) (seen robot) (not (lit attic)))))
