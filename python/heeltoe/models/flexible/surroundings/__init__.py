"""Surroundings of the elastic dam that answer its motion: water with sound, rock with waves."""
